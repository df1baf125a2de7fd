//! Surfaces with more than a plain texture: mip maps, relief, maps of what they are made of, highlights.

use super::erased::Carried;
use super::general::{Look, Triangles, Visitor, on_image};
use super::lamps::{AnyReflectance, Lamp, Lamps};
use super::maps::Chains;
use super::painted::Painted;
use super::{Canvas, position, to_light};
use crate::error::Error;
use crate::options::{Filter, Projection, RenderOptions, Shading};
use crate::scene::{Camera, Detail, Model, Part, Vertex};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::Lanes;
use alberti::raster::{Gradient, PerPixel};
use alberti::shaders::material::{Framed, Gouraud, Lighting, Material};
use alberti::{
    Band, DepthFormat, FragmentStage, Object, Point3, Projector, Rgba8, Varying, Vector3, VertexStage,
};

/// Whether a part is more than a plain surface in a picture with these options.
pub(crate) fn is_lit(part: &Part, model: &Model, options: &RenderOptions) -> bool {
    let plain =
        Detail { specular: part.detail.specular, shininess: part.detail.shininess, ..Detail::default() };
    let mipmapped = part.texture.is_some() && !matches!(options.filter, Filter::Nearest | Filter::Bilinear);
    let highlights = !matches!(options.shading, Shading::Unlit | Shading::VertexColor | Shading::Lambert);
    let lamps = options.shading.is_lit() && (!model.lights.is_empty() || model.ambient.is_some());
    options.shading != Shading::VertexColor && (part.detail != plain || mipmapped || highlights || lamps)
}

/// A material under lights, lit at fragments or at vertices.
#[derive(Clone, Copy)]
enum Lit<'a> {
    ByFragment(Material<Painted<'a>, &'a [Lamp], AnyReflectance>),
    ByVertex(ByVertex<'a>),
}

impl Look<Framed> for Lit<'_> {
    fn visit(&self, visitor: &mut impl Visitor<Framed>) {
        match *self {
            Self::ByFragment(material) => visitor.visit(material),
            Self::ByVertex(material) => visitor.visit(material),
        }
    }
}

/// A surface whose first two axes are lights.
#[derive(Clone, Copy, Debug)]
struct ByVertex<'a>(Gouraud<Painted<'a>>);

impl FragmentStage<Framed> for ByVertex<'_> {
    type Color = Rgba8;
    type Derivatives = PerPixel;

    #[inline(always)]
    fn shade(&self, Framed { axes: [scattered, mirrored, _], uv, .. }: Framed) -> Option<Rgba8> {
        self.0.shade((scattered, (mirrored, uv)))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        &(_, [scattered, mirrored, _], uv): &<Framed as Varying>::Of<L::Number>,
        gradient: &Gradient<<Framed as Varying>::Of<L::Number>>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let gradient = gradient.map(|(_, [scattered, mirrored, _], uv)| (scattered, (mirrored, uv)));
        self.0.shade_lanes(lanes, &(scattered, (mirrored, uv)), &gradient, mask)
    }
}

/// The vertex stage of such surfaces. Lights at vertices are carried instead of the first two axes.
#[derive(Clone, Copy)]
struct CarryFrame<'a> {
    by_vertex: Option<Lighting<&'a [Lamp], AnyReflectance>>,
    projector: Option<Projector>,
}

impl VertexStage<Vertex> for CarryFrame<'_> {
    type Varying = Carried<Framed>;

    fn shade(&self, v: &Vertex) -> (Point3<Object>, Carried<Framed>) {
        let [x, y, z, handedness] = v.tangent;
        let (place, normal, tangent) =
            (Vec3::from_array(v.position), Vec3::from_array(v.normal), Vec3::new(x, y, z));
        let axes = match &self.by_vertex {
            None => [tangent, normal.cross(tangent) * handedness, normal],
            Some(lighting) => {
                let [scattered, mirrored] = lighting.at_vertex(Point3::new(place), Vector3::new(normal));
                [scattered, mirrored, normal]
            }
        };
        let framed = Framed { position: place, axes, uv: Vec2::from_array(v.uv) };
        (position(v), (on_image(self.projector, v), framed))
    }
}

/// What lit surfaces share.
#[derive(Debug)]
pub(crate) struct Studio {
    pub(super) chains: Chains,
    pub(super) lamps: Lamps,
}

impl Studio {
    /// What a model needs.
    ///
    /// # Errors
    /// A texture that cannot be drawn.
    pub(crate) fn new(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Self, Error> {
        let parallel = options.projection != Projection::Perspective;
        Ok(Self {
            chains: Chains::new(model, options)?,
            lamps: Lamps::new(model, camera, parallel, to_light(camera)),
        })
    }
}

impl<'a> Canvas<'a> {
    /// A surface with all that it has, by any policies.
    pub(super) fn draw_lit<D: DepthFormat>(
        &mut self,
        part: &Part,
        triangles: &[[u32; 3]],
        band: &mut Band<'_, Rgba8, D>,
    ) {
        let Studio { chains, lamps } = self.studio;
        let shading = self.options.shading;
        let painted = Painted::new(part, self.model, chains, self.options, self.camera);
        let material = painted.lit(shading, part.detail.shininess, lamps);
        let by_vertex = (shading == Shading::Gouraud).then_some(material.lighting);
        let look = match by_vertex {
            None => Lit::ByFragment(material),
            Some(_) => Lit::ByVertex(ByVertex(Gouraud { layers: material.layers })),
        };
        let vertex_stage = CarryFrame { by_vertex, projector: self.projector() };
        self.by_policies(&look, &mut Triangles { triangles, vertex_stage, band });
    }
}
