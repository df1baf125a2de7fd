//! Any policies with any fragment stage: a kernel for each of the rasterizer's policies, and the stage behind a
//! pointer.

use super::erased::{
    Bare, Carried, Differentiable, Erased, ErasedFixed, Looks, OfFirst, OfUv, Thrown, erase, erase_fixed,
};
use super::lines::Lines;
use super::{Canvas, Taps, color, lambert, position};
use crate::options::{Filter, Interpolation, Numbers, Shading, Subpixel, Wrap};
use crate::scene::{Part, Vertex};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Floating, Machine, One};
use alberti::raster::FloatingPoint;
use alberti::shaders::{Modulate, Slide, Solid, Tinted, Unlit, VertexColor};
use alberti::texture::{self, Clamp, Size, Texture};
use alberti::{
    Band, Bounded, DepthFormat, Exact, FixedPoint, FragmentStage, Homogeneous, Object, Plane, Point3,
    Projector, Rgba8, Sub4, Sub8, Vector3, VertexStage, World, draw_by, for_lanes,
};

/// From names to types: the filter of what is thrown on a surface.
macro_rules! with_slide {
    ($slide:expr, $surface:expr, |$stage:ident| $body:expr) => {
        with_slide!(@ $slide, $surface, $stage, $body, Nearest, Bilinear)
    };
    (@ $slide:expr, $surface:expr, $stage:ident, $body:expr, $($filter:ident),*) => {
        match ($slide.0, Taps::of($slide.1)) {
            $((image, Taps::$filter) => {
                let image = image.sampler::<texture::$filter, Clamp>();
                let $stage = Thrown(Slide { surface: $surface, image, mix: Modulate });
                $body
            })*
        }
    };
}

/// The vertex stages of plain surfaces: one type for all, whatever is carried. What the fragment stage does not need is
/// constant, so that it has no part in how far a straight line may go.
#[derive(Clone, Copy)]
struct Carry {
    shading: Shading,
    textured: bool,
    projector: Option<Projector>,
}

impl VertexStage<Vertex> for Carry {
    type Varying = Carried<Looks>;

    fn shade(&self, v: &Vertex) -> (Point3<Object>, Carried<Looks>) {
        let first = match self.shading {
            Shading::VertexColor => Vec3::from_array(v.color),
            Shading::Unlit => Vec3::ZERO,
            _ => Vec3::from_array(v.normal),
        };
        let uv = if self.textured { Vec2::from_array(v.uv) } else { Vec2::ZERO };
        (position(v), (on_image(self.projector, v), (first, uv)))
    }
}

/// Where a projector's image meets a vertex. The model stands in the world where it was made.
pub(super) fn on_image(projector: Option<Projector>, v: &Vertex) -> Homogeneous {
    let world = Point3::new(Vec3::from_array(v.position));
    projector.map_or(Homogeneous::default(), |projector| projector.project(world))
}

/// Triangles of a part, with what their vertices carry, and where they go.
pub(super) struct Triangles<'t, 'b, Vs, D: DepthFormat> {
    pub(super) triangles: &'t [[u32; 3]],
    pub(super) vertex_stage: Vs,
    pub(super) band: &'t mut Band<'b, Rgba8, D>,
}

/// What becomes a fragment stage when it is asked for.
pub(super) trait Look<V: Differentiable> {
    /// Has the stage visited.
    fn visit(&self, visitor: &mut impl Visitor<V>);
}

impl<'a> Canvas<'a> {
    /// A plain surface, by any policies.
    pub(crate) fn in_general<D: DepthFormat>(
        &mut self,
        part: &Part,
        triangles: &[[u32; 3]],
        band: &mut Band<'_, Rgba8, D>,
    ) {
        let surface = self.surface(part);
        self.by_policies(&surface, &mut Triangles { triangles, vertex_stage: surface.carry(), band });
    }

    /// From names to types: interpolation and numbers, then lanes, then subpixels.
    pub(super) fn by_policies<V, Vs, D>(&mut self, look: &impl Look<V>, target: &mut Triangles<'_, '_, Vs, D>)
    where
        V: Differentiable,
        Vs: VertexStage<Vertex, Varying = Carried<V>> + Copy,
        D: DepthFormat,
    {
        let policies = self.options.policies;
        match self.lines() {
            None if policies.interpolation == Interpolation::Plane => self.in_floats(Plane, look, target),
            None => self.in_floats(Exact, look, target),
            Some(lines) if policies.numbers == Numbers::Float => {
                self.in_floats(FloatingPoint(lines), look, target);
            }
            Some(lines) => look.visit(&mut EraseFixed {
                slide: self.thrown(),
                then: &mut |stage| self.snapped(One, FixedPoint(lines), stage, target),
            }),
        }
    }

    fn in_floats<P, V, Vs, D>(
        &mut self,
        interpolation: P,
        look: &impl Look<V>,
        target: &mut Triangles<'_, '_, Vs, D>,
    ) where
        P: alberti::Interpolation,
        V: Differentiable,
        Vs: VertexStage<Vertex, Varying = Carried<V>> + Copy,
        D: DepthFormat,
    {
        let Some(machine) = Machine::all().next() else { return };
        for_lanes!(machine, lanes => look.visit(&mut Erase {
            lanes,
            slide: self.thrown(),
            then: &mut |stage| self.snapped(lanes, interpolation, stage, target),
        }));
    }

    fn snapped<L, P, F, V, Vs, D>(
        &mut self,
        lanes: L,
        interpolation: P,
        stage: F,
        target: &mut Triangles<'_, '_, Vs, D>,
    ) where
        L: Floating,
        P: alberti::Interpolation,
        V: Differentiable,
        F: FragmentStage<Carried<V>, Color = Rgba8>,
        Vs: VertexStage<Vertex, Varying = Carried<V>> + Copy,
        D: DepthFormat,
    {
        match self.options.policies.subpixel {
            Subpixel::Sub4 => {
                self.draw_general::<Sub4, _, _, _, _, _, _>(lanes, interpolation, stage, target);
            }
            Subpixel::Sub8 => {
                self.draw_general::<Sub8, _, _, _, _, _, _>(lanes, interpolation, stage, target);
            }
        }
    }

    fn draw_general<S, L, P, F, V, Vs, D>(
        &mut self,
        lanes: L,
        interpolation: P,
        stage: F,
        Triangles { triangles, vertex_stage, band }: &mut Triangles<'_, '_, Vs, D>,
    ) where
        S: alberti::Subpixel,
        L: Floating,
        P: alberti::Interpolation,
        V: Differentiable,
        F: FragmentStage<Carried<V>, Color = Rgba8>,
        Vs: VertexStage<Vertex, Varying = Carried<V>> + Copy,
        D: DepthFormat,
    {
        let pass = self.pass(self.view, triangles, *vertex_stage, stage, interpolation);
        draw_by(lanes, &pass, band, &mut self.slots::<S, Carried<V>>(triangles), &mut self.stats);
    }

    /// A projector's image, and how it is read.
    fn thrown(&self) -> Option<SlideImage<'a>> {
        self.slide.map(|(_, image)| (image, self.options.filter))
    }

    /// The policy of straight lines, if it is one.
    fn lines(&self) -> Option<Lines> {
        let sides = self.textures.iter().map(|t| t.width().max(t.height()));
        match self.options.policies.interpolation {
            Interpolation::Exact | Interpolation::Plane => None,
            Interpolation::Spans(length) => Some(Lines::Spans(length.columns())),
            Interpolation::Bounded(texels) => {
                // Without a texture, a step of a colour.
                let side = sides.max().and_then(|side| side.try_into().ok()).unwrap_or(255);
                Some(Lines::Bounded(Bounded::texels(texels, side)))
            }
            Interpolation::Affine => Some(Lines::Affine),
        }
    }

    fn surface(&self, part: &Part) -> Surface<'a> {
        Surface {
            texture: part.texture.and_then(|t| self.textures.get(t)).copied(),
            tint: color(part.diffuse),
            light: self.light,
            shading: self.options.shading,
            filter: self.options.filter,
            wrap: self.options.wrap,
            projector: self.projector(),
        }
    }
}

/// What a part looks like.
struct Surface<'a> {
    texture: Option<Texture<'a, Rgba8>>,
    tint: Rgba8,
    light: Vector3<World>,
    shading: Shading,
    filter: Filter,
    wrap: Wrap,
    projector: Option<Projector>,
}

/// What is thrown on a surface, and how it is read.
type SlideImage<'a> = (Texture<'a, Rgba8>, Filter);

impl Surface<'_> {
    fn carry(&self) -> Carry {
        let textured = self.texture.is_some() && self.shading != Shading::VertexColor;
        Carry { shading: self.shading, textured, projector: self.projector }
    }

    /// A white tint changes no byte.
    fn visit_textured<Z: Size>(&self, texture: Texture<'_, Rgba8, Z>, visitor: &mut impl Visitor<Looks>) {
        with_sampler!(texture, self.filter, self.wrap, |sampler| {
            self.visit_lit(Tinted { surface: Unlit(sampler), tint: self.tint }, visitor);
        });
    }

    fn visit_lit(&self, surface: impl FragmentStage<Vec2, Color = Rgba8>, visitor: &mut impl Visitor<Looks>) {
        if self.shading.is_lit() {
            visitor.visit(lambert(surface, self.light));
        } else {
            visitor.visit(OfUv(surface));
        }
    }
}

impl Look<Looks> for Surface<'_> {
    /// From names to types.
    fn visit(&self, visitor: &mut impl Visitor<Looks>) {
        match self.texture {
            _ if self.shading == Shading::VertexColor => visitor.visit(OfFirst(VertexColor)),
            None => self.visit_lit(Solid(self.tint), visitor),
            Some(texture) => match texture.power_of_two() {
                Some(texture) => self.visit_textured(texture, visitor),
                None => self.visit_textured(texture, visitor),
            },
        }
    }
}

/// Something to do with a surface of whatever type.
pub(super) trait Visitor<V: Differentiable> {
    fn visit(&mut self, surface: impl FragmentStage<V, Color = Rgba8>);
}

/// Goes on with the surface behind a pointer, and the image on it, if there is one, behind another.
struct Erase<'t, 'a, L: Floating, V: Differentiable> {
    lanes: L,
    slide: Option<SlideImage<'a>>,
    then: &'t mut dyn FnMut(Erased<'_, L, V>),
}

impl<L: Floating, V: Differentiable> Visitor<V> for Erase<'_, '_, L, V> {
    fn visit(&mut self, surface: impl FragmentStage<V, Color = Rgba8>) {
        let Self { lanes, slide, then } = self;
        erase(*lanes, Bare(surface), &mut |surface| match *slide {
            None => then(surface),
            Some(slide) => with_slide!(slide, surface, |stage| erase(*lanes, stage, *then)),
        });
    }
}

/// The same in fixed point.
struct EraseFixed<'t, 'a, V: Differentiable> {
    slide: Option<SlideImage<'a>>,
    then: &'t mut dyn FnMut(ErasedFixed<'_, V>),
}

impl<V: Differentiable> Visitor<V> for EraseFixed<'_, '_, V> {
    fn visit(&mut self, surface: impl FragmentStage<V, Color = Rgba8>) {
        let Self { slide, then } = self;
        erase_fixed(Bare(surface), &mut |surface| match *slide {
            None => then(surface),
            Some(slide) => with_slide!(slide, surface, |stage| erase_fixed(stage, *then)),
        });
    }
}
