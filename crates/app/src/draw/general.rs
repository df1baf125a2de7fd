//! Any surface by any policies: a kernel for each kind of interpolation, and one fragment stage behind a pointer. The
//! stage is all surfaces that there are, with a projector's image on them.

use super::clothed::{Clothed, Triangles};
use super::erased::{Attributes, erase, erase_fixed};
use super::hazy::Hazy;
use super::kept::Kept;
use super::lamps::Lamps;
use super::maps::{Chains, any_filter};
use super::painted::{Painted, Shine};
use super::plain::Skin;
use super::studio::{Lamplit, Rig};
use super::used::Used;
use super::{Canvas, Drawing, memory};
use crate::error::Error;
use crate::options::{Arithmetic, Filter, Interpolation, RenderOptions, Shading};
use crate::scene::{Camera, Detail, Model, Part};
use alberti::lanes::{Lanes, Machine, One};
use alberti::raster::PerPixel;
use alberti::raster::color::{AnyBlend, Blended, BlueNoise, Pattern as _};
use alberti::shaders::material::{AnyLight, AnyLightSpace, Framed, Gouraud, InSpace, Material};
use alberti::shaders::{Mix, Slide, Unlit, VertexColor};
use alberti::texture::{AnyFilter, Clamp, Sampler, format::Rgba8888};
use alberti::{FixedPoint, FragmentStage, Fragments, Lines, Planes, Rgba8, Stats, for_lanes};
use std::sync::Arc;

/// Whether a part is more than a plain surface in a picture with these options.
pub(super) fn is_lit(part: &Part, model: &Model, options: &RenderOptions) -> bool {
    let Detail { specular, shininess, blend, alpha_test, is_share, shiny, .. } = part.detail;
    let plain = Detail { specular, shininess, blend, alpha_test, is_share, shiny, ..Detail::default() };
    let mipmapped = part.texture.is_some() && !matches!(options.filter, Filter::Nearest | Filter::Bilinear);
    let highlights = !matches!(options.shading, Shading::Unlit | Shading::VertexColor | Shading::Lambert);
    let lamps = options.shading.is_lit() && (!model.lights.is_empty() || model.ambient.is_some());
    let more = mipmapped || highlights || lamps || options.in_linear_light();
    options.shading != Shading::VertexColor && (part.detail != plain || more)
}

/// The maps and the lights that all surfaces share.
#[derive(Debug)]
pub(crate) struct Studio {
    pub(super) chains: Arc<Chains>,
    pub(super) lamps: Lamps,
}

impl Studio {
    /// Those of a model.
    ///
    /// # Errors
    /// A texture that cannot be drawn.
    pub(crate) fn new(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Self, Error> {
        Ok(Self::with(Arc::new(Chains::new(model, options)?), model, camera, options))
    }

    /// The same with mip maps that are there.
    pub(crate) fn with(chains: Arc<Chains>, model: &Model, camera: &Camera, options: &RenderOptions) -> Self {
        Self { chains, lamps: Lamps::new(model, camera, options, &Rig::new(camera, options)) }
    }
}

/// Any surface, asked once for the samples that are worked on together.
#[derive(Clone, Copy)]
pub(super) enum Surface<'a> {
    Colors,
    Unlit(Unlit<Skin<'a>>),
    Lit(Lamplit<Skin<'a>>),
    ByFragment(InSpace<Material<Painted<'a>, &'a [AnyLight], Shine>, AnyLightSpace>),
    ByVertex(InSpace<Gouraud<Painted<'a>>, AnyLightSpace>),
}

impl FragmentStage<Framed> for Surface<'_> {
    type Color = Rgba8;
    type Derivatives = PerPixel;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Framed>) -> (L::U32, L::Mask) {
        match self {
            Self::Colors => VertexColor.shade(&fragments.part(|framed| framed.axes[2])),
            Self::Unlit(skin) => skin.shade(&fragments.part(|framed| framed.uv)),
            Self::Lit(skin) => skin.shade(&fragments.part(|framed| (framed.axes[2], framed.uv))),
            Self::ByFragment(material) => material.shade(fragments),
            Self::ByVertex(material) => material.shade(&fragments.part(|framed| {
                let [scattered, mirrored, _] = framed.axes;
                (scattered, (mirrored, framed.uv))
            })),
        }
    }
}

/// A surface with a projector's image on it, a fog before it and holes in it, if there are such.
#[derive(Clone, Copy)]
pub(super) struct Shown<'a> {
    pub(super) surface: Surface<'a>,
    pub(super) image: Option<Sampler<'a, Rgba8888, AnyFilter, Clamp>>,
    pub(super) hazy: Option<Hazy>,
    /// The least alpha that is drawn.
    pub(super) least: u8,
    /// The size of an image in whose smaller levels alpha is the share of samples that are drawn.
    pub(super) shares: Option<[u32; 2]>,
    /// The place of the pattern that says which samples these are.
    pub(super) sheet: [i32; 2],
}

impl FragmentStage<Attributes> for Shown<'_> {
    type Color = Rgba8;
    type Derivatives = PerPixel;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Attributes>) -> (L::U32, L::Mask) {
        let lanes = fragments.lanes;
        let (mut color, mut mask) = self.surface.shade(&fragments.part(|(_, framed)| *framed));
        if self.least > 0 {
            let mut least = lanes.word(self.least.into());
            if let Some(size) = self.shares {
                let gradient = fragments.gradient.map(|(_, framed)| framed.uv);
                let is_smaller = lanes.less(lanes.splat(0.0), gradient.lod_lanes(lanes, size));
                let ([column, row], [right, down]) = (fragments.place, self.sheet);
                let place = [column.wrapping_add(right), row.wrapping_add(down)];
                let any = BlueNoise.thresholds(lanes, place) + lanes.word(1);
                least = lanes.select_words(is_smaller, any, least);
            }
            mask = mask & !lanes.less_words(lanes.shr(color, 24), least);
        }
        if let Some(image) = self.image {
            let slide = Slide { surface: (), image, mix: Mix::Modulate };
            color = slide.on(lanes, &fragments.varying.0, color, mask);
        }
        if let Some(hazy) = self.hazy {
            color = hazy.on(lanes, fragments.varying.1.position, color);
        }
        (color, mask)
    }
}

impl Shown<'_> {
    /// Whether the triangles of a part are on sheets. They are drawn by these, so those that are mixed with what is
    /// behind them are all on one.
    fn has_sheets(self, part: &Part) -> bool {
        self.shares.is_some() && part.detail.blend == AnyBlend::Replace
    }

    /// The same for a triangle, on the sheet that it is on. Those are as far from each other as they can be among
    /// 32 x 32 places.
    pub(super) fn on(self, part: &Part, triangle: &[u32; 3]) -> Self {
        let number = if self.has_sheets(part) { sheet(triangle) } else { 0 };
        Self { sheet: [number % 4, number / 4].map(|step| step.cast_signed() * 8), ..self }
    }
}

impl<'a> Drawing<'a> {
    /// A surface by any policies.
    pub(super) fn draw_general(&mut self, part: &Part, triangles: &[[u32; 3]], target: &mut Canvas<'_>) {
        let clothed = self.clothed(part);
        let shown = self.shown(clothed.surface, part);
        if !shown.has_sheets(part) {
            return self.draw_dressed(part, triangles, (&clothed, shown), target);
        }
        for number in 0..SHEETS {
            let own: Vec<_> = triangles.iter().copied().filter(|own| sheet(own) == number).collect();
            if !own.is_empty() {
                self.draw_dressed(part, &own, (&clothed, shown.on(part, &own[0])), target);
            }
        }
    }

    fn draw_dressed(
        &mut self,
        part: &Part,
        triangles: &[[u32; 3]],
        (clothed, shown): (&Clothed<'a>, Shown<'a>),
        target: &mut Canvas<'_>,
    ) {
        let Used { vertices, triangles } = self.sided(triangles);
        let (vertices, triangles) = (&*vertices, &*triangles);
        let mesh = Triangles { clothed, vertices, triangles, numbers: None, bare: false };
        let stats = self.by_policies(&mesh, shown, part.detail.blend, target);
        self.stats += stats;
    }

    /// A part's surface with all that lies on it and before it.
    pub(super) fn shown(&self, surface: Surface<'a>, part: &Part) -> Shown<'a> {
        let image = self.slide.map(|(_, image)| image.sampler(any_filter(self.options.filter), Clamp));
        Shown { image, hazy: self.hazy(part.detail.blend), ..self.surface_alone(surface, part) }
    }

    /// A part's surface with its holes.
    fn surface_alone(&self, surface: Surface<'a>, part: &Part) -> Shown<'a> {
        let detail = &part.detail;
        let filter = detail.filter.unwrap_or(self.options.filter);
        let has_levels = !matches!(filter, Filter::Nearest | Filter::Bilinear);
        let image = part.texture.and_then(|image| self.model.textures.get(image));
        let shares = image.filter(|_| detail.is_share && has_levels);
        Shown {
            surface,
            image: None,
            hazy: None,
            least: detail.alpha_test,
            shares: shares.map(|image| [image.width, image.height]),
            sheet: [0; 2],
        }
    }

    /// A part's surface, and all that its attributes are made of.
    pub(super) fn clothed(&self, part: &Part) -> Clothed<'a> {
        let Studio { chains, lamps } = self.studio;
        let (options, shading) = (self.options, self.options.shading);
        let painted = Painted::new(part, self.model, chains, options, self.camera);
        let material = painted.lit(shading, part.detail.shininess, lamps);
        let lit = is_lit(part, self.model, options);
        let linear = options.in_linear_light();
        let space = light_space(linear);
        let surface = match shading {
            Shading::VertexColor => Surface::Colors,
            Shading::Gouraud if lit => {
                Surface::ByVertex(InSpace { surface: Gouraud { layers: material.layers }, space })
            }
            _ if lit => Surface::ByFragment(InSpace { surface: material, space }),
            Shading::Unlit => Surface::Unlit(Unlit(self.skin(part))),
            _ => Surface::Lit(self.lit(self.skin(part))),
        };
        let textured = lit || (part.texture.is_some() && shading != Shading::VertexColor);
        let projector = self.slide.map(|(projector, _)| projector);
        let placed = self.options.haze.is_some();
        let colored = part.detail.carries_colors();
        Clothed { surface, lighting: material.lighting, linear, colored, textured, placed, projector }
    }

    /// A part's surface as a material at each fragment, whatever the shading, with all attributes but an image's.
    pub(super) fn clothed_whole(&self, part: &Part) -> (Clothed<'a>, Shown<'a>) {
        let Studio { chains, lamps } = self.studio;
        let painted = Painted::new(part, self.model, chains, self.options, self.camera);
        let material = painted.lit(self.options.shading, part.detail.shininess, lamps);
        let linear = self.options.in_linear_light();
        let surface = Surface::ByFragment(InSpace { surface: material, space: light_space(linear) });
        let (lighting, colored) = (material.lighting, part.detail.carries_colors());
        let clothed =
            Clothed { surface, lighting, linear, colored, textured: true, placed: true, projector: None };
        (clothed, self.surface_alone(surface, part))
    }

    /// The stage behind a pointer, in one of few kernels, mixed with what is there.
    pub(super) fn by_policies(
        &self,
        mesh: &Triangles<'_, '_>,
        stage: impl FragmentStage<Attributes, Color = Rgba8> + Sync,
        blend: AnyBlend,
        target: &mut Canvas<'_>,
    ) -> Stats {
        // Mixed surfaces hide nothing.
        let kept = Kept { format: target.depth_format(), written: blend == AnyBlend::Replace };
        let mut target = target.with_depth(kept);
        let target = &mut target.with_color(Blended { format: Rgba8888, by: blend });
        let (mut room, mut slots) = memory(mesh);
        let (mut stats, threads) = (Stats::default(), self.options.threads);
        let (policies, lines) = (self.options.policies, self.lines());
        if let (Some(lines), Arithmetic::Fixed) = (lines, policies.arithmetic) {
            erase_fixed(self.derivatives(), stage, |stage| {
                let pass = self.pass(mesh, stage, &mut slots).interpolation(FixedPoint(lines));
                { pass }.count_by_threads(One, threads, &mut room, target, &mut stats);
            });
            return stats;
        }
        let Some(machine) = Machine::all().next() else { return stats };
        for_lanes!(machine, lanes => erase(lanes, self.derivatives(), stage, |stage| {
            let mut pass = self.pass(mesh, stage, &mut slots);
            let (room, stats) = (&mut room, &mut stats);
            match (policies.interpolation, lines) {
                (_, Some(lines)) => {
                    pass.interpolation(lines).count_by_threads(lanes, threads, room, target, stats);
                }
                (Interpolation::Plane, None) => {
                    pass.interpolation(Planes).count_by_threads(lanes, threads, room, target, stats);
                }
                (_, None) => pass.count_by_threads(lanes, threads, room, target, stats),
            }
        }));
        stats
    }

    /// The straight lines of the options' interpolation, if it has some.
    pub(super) fn lines(&self) -> Option<Lines> {
        match self.options.policies.interpolation {
            Interpolation::Exact | Interpolation::Plane => None,
            Interpolation::Spans(length) => Lines::spans(length.columns()),
            Interpolation::Bounded(texels) => Some(Lines::bounded_texels(texels, self.model.largest_side())),
            Interpolation::Affine => Some(Lines::affine()),
        }
    }
}

/// The sheets of a pattern of holes. What is on different ones adds up as if each sample were drawn by chance.
const SHEETS: u32 = 16;

/// The sheet that a triangle is on. Those of a polygon begin with the same vertex most often, and are on the same.
fn sheet(triangle: &[u32; 3]) -> u32 {
    // Numbers near each other get sheets far apart, by the golden ratio (Knuth 1973, 6.4).
    triangle[0].wrapping_mul(0x9e37_79b9) / (u32::MAX / SHEETS + 1)
}

/// The space of light.
fn light_space(linear: bool) -> AnyLightSpace {
    if linear { AnyLightSpace::Linear } else { AnyLightSpace::Srgb }
}
