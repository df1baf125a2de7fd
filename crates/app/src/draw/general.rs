//! Any policies with any fragment stage: a kernel for each of the rasterizer's policies, and the stage behind a
//! pointer.

use super::erased::{Bare, Carried, Erased, ErasedFixed, Looks, OfFirst, OfUv, Thrown, erase, erase_fixed};
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

/// The vertex stages: one type for all, whatever is carried. What the fragment stage does not need is constant, so that
/// it has no part in how far a straight line may go.
#[derive(Clone, Copy)]
struct Carry {
    shading: Shading,
    textured: bool,
    projector: Option<Projector>,
}

impl VertexStage<Vertex> for Carry {
    type Varying = Carried;

    fn shade(&self, v: &Vertex) -> (Point3<Object>, Carried) {
        let first = match self.shading {
            Shading::VertexColor => Vec3::from_array(v.color),
            Shading::Unlit => Vec3::ZERO,
            _ => Vec3::from_array(v.normal),
        };
        let uv = if self.textured { Vec2::from_array(v.uv) } else { Vec2::ZERO };
        // The model stands in the world where it was made.
        let world = Point3::new(Vec3::from_array(v.position));
        let place = self.projector.map_or(Homogeneous::default(), |projector| projector.project(world));
        (position(v), (place, (first, uv)))
    }
}

/// Triangles of a part, and where they go.
struct Triangles<'t, 'b, D: DepthFormat> {
    triangles: &'t [[u32; 3]],
    vertex_stage: Carry,
    band: &'t mut Band<'b, Rgba8, D>,
}

impl<'a> Canvas<'a> {
    /// From names to types: interpolation and numbers, then lanes, then subpixels.
    pub(crate) fn in_general<D: DepthFormat>(
        &mut self,
        part: &Part,
        triangles: &[[u32; 3]],
        band: &mut Band<'_, Rgba8, D>,
    ) {
        let surface = self.surface(part);
        let target = &mut Triangles { triangles, vertex_stage: surface.carry(), band };
        let policies = self.options.policies;
        match self.lines() {
            None if policies.interpolation == Interpolation::Plane => self.in_floats(Plane, &surface, target),
            None => self.in_floats(Exact, &surface, target),
            Some(lines) if policies.numbers == Numbers::Float => {
                self.in_floats(FloatingPoint(lines), &surface, target);
            }
            Some(lines) => surface.visit(&mut EraseFixed {
                slide: surface.slide,
                then: &mut |stage| self.snapped(One, FixedPoint(lines), stage, target),
            }),
        }
    }

    fn in_floats<P: alberti::Interpolation, D: DepthFormat>(
        &mut self,
        interpolation: P,
        surface: &Surface<'_>,
        target: &mut Triangles<'_, '_, D>,
    ) {
        let Some(machine) = Machine::all().next() else { return };
        for_lanes!(machine, lanes => surface.visit(&mut Erase {
            lanes,
            slide: surface.slide,
            then: &mut |stage| self.snapped(lanes, interpolation, stage, target),
        }));
    }

    fn snapped<L, P, F, D>(&mut self, lanes: L, interpolation: P, stage: F, target: &mut Triangles<'_, '_, D>)
    where
        L: Floating,
        P: alberti::Interpolation,
        F: FragmentStage<Carried, Color = Rgba8>,
        D: DepthFormat,
    {
        match self.options.policies.subpixel {
            Subpixel::Sub4 => self.draw_general::<Sub4, _, _, _, _>(lanes, interpolation, stage, target),
            Subpixel::Sub8 => self.draw_general::<Sub8, _, _, _, _>(lanes, interpolation, stage, target),
        }
    }

    fn draw_general<S, L, P, F, D>(
        &mut self,
        lanes: L,
        interpolation: P,
        stage: F,
        Triangles { triangles, vertex_stage, band }: &mut Triangles<'_, '_, D>,
    ) where
        S: alberti::Subpixel,
        L: Floating,
        P: alberti::Interpolation,
        F: FragmentStage<Carried, Color = Rgba8>,
        D: DepthFormat,
    {
        let pass = self.pass(self.view, triangles, *vertex_stage, stage, interpolation);
        draw_by(lanes, &pass, band, &mut self.slots::<S, Carried>(triangles), &mut self.stats);
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
            projector: self.slide.map(|(projector, _)| projector),
            slide: self.slide.map(|(_, image)| (image, self.options.filter)),
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
    slide: Option<SlideImage<'a>>,
}

/// What is thrown on a surface, and how it is read.
type SlideImage<'a> = (Texture<'a, Rgba8>, Filter);

impl Surface<'_> {
    fn carry(&self) -> Carry {
        let textured = self.texture.is_some() && self.shading != Shading::VertexColor;
        Carry { shading: self.shading, textured, projector: self.projector }
    }

    /// From names to types: the fragment stage.
    fn visit(&self, visitor: &mut impl Visitor) {
        match self.texture {
            _ if self.shading == Shading::VertexColor => visitor.visit(OfFirst(VertexColor)),
            None => self.visit_lit(Solid(self.tint), visitor),
            Some(texture) => match texture.power_of_two() {
                Some(texture) => self.visit_textured(texture, visitor),
                None => self.visit_textured(texture, visitor),
            },
        }
    }

    /// A white tint changes no byte.
    fn visit_textured<Z: Size>(&self, texture: Texture<'_, Rgba8, Z>, visitor: &mut impl Visitor) {
        with_sampler!(texture, self.filter, self.wrap, |sampler| {
            self.visit_lit(Tinted { surface: Unlit(sampler), tint: self.tint }, visitor);
        });
    }

    fn visit_lit(&self, surface: impl FragmentStage<Vec2, Color = Rgba8>, visitor: &mut impl Visitor) {
        if self.shading.is_lit() {
            visitor.visit(lambert(surface, self.light));
        } else {
            visitor.visit(OfUv(surface));
        }
    }
}

/// Something to do with a surface of whatever type.
trait Visitor {
    fn visit(&mut self, surface: impl FragmentStage<Looks, Color = Rgba8>);
}

/// Goes on with the surface behind a pointer, and the image on it, if there is one, behind another.
struct Erase<'t, 'a, L: Floating> {
    lanes: L,
    slide: Option<SlideImage<'a>>,
    then: &'t mut dyn FnMut(Erased<'_, L>),
}

impl<L: Floating> Visitor for Erase<'_, '_, L> {
    fn visit(&mut self, surface: impl FragmentStage<Looks, Color = Rgba8>) {
        let Self { lanes, slide, then } = self;
        erase(*lanes, Bare(surface), &mut |surface| match *slide {
            None => then(surface),
            Some(slide) => with_slide!(slide, surface, |stage| erase(*lanes, stage, *then)),
        });
    }
}

/// The same in fixed point.
struct EraseFixed<'t, 'a> {
    slide: Option<SlideImage<'a>>,
    then: &'t mut dyn FnMut(ErasedFixed<'_>),
}

impl Visitor for EraseFixed<'_, '_> {
    fn visit(&mut self, surface: impl FragmentStage<Looks, Color = Rgba8>) {
        let Self { slide, then } = self;
        erase_fixed(Bare(surface), &mut |surface| match *slide {
            None => then(surface),
            Some(slide) => with_slide!(slide, surface, |stage| erase_fixed(stage, *then)),
        });
    }
}
