//! Detail on surfaces: tangent frames, and height and normal maps in them.
//!
//! A texture describes the detail in a frame that lies on the surface, the tangent frame. Its x is along the direction
//! in which u grows, its y along that of v, its z along the normal. So one map serves for all surfaces, however they
//! bend.
//!
//! | what | how | result |
//! |---|---|---|
//! | tangent frame of a formula | [`Parametric`] | `Frame<Tangent, Object>` |
//! | tangent frame of a triangle | [`triangle_frame`] | `Frame<Tangent, Object>` |
//! | tangents of a mesh | [`vertex_tangents`], [`frame_of_tangent`] | as in glTF; `Frame<Tangent, Object>` |
//! | the same, by MikkTSpace | `mikktspace`, with the feature of that name, which needs an allocator | as in glTF |
//! | normal map | [`normal`], [`normal_of_two`], [`strengthened`] | a normal in the frame |
//! | bump map | [`Relief::normal`], [`HeightMap::slopes_lanes`] and [`normal_of_slope`] | a normal in the frame |
//! | bump map on sheared axes | [`bump`] | a normal in object space |
//! | bump map out of the frame | [`bump_lanes`] | a normal in object space |
//! | parallax map | [`Relief::parallax`] | where to read the other maps |
//! | displacement map | [`Grid`], [`Subdivision`], [`displace`], [`displaced_mesh`] | a mesh in object space |
//! | out of the frame | [`normal_to_parent`] | a normal in object space |
//! | material maps | [`lambert`], [`phong`], [`blinn_phong`], [`shininess`], [`ambient_occlusion`], [`Wettable`] | shares |
//!
//! Functions for fragments have a form over lanes too, `..._lanes`, for several samples at a time, in `f32` and in
//! fixed point. The plain function is that on one lane, so both give the same bits.
//!
//! Source: Blinn, "Simulation of wrinkled surfaces", SIGGRAPH 1978, for the frame and the bump; each function names its
//! own.

mod displacement;
#[cfg(any(feature = "serde", feature = "arbitrary"))]
mod form;
mod height;
mod material;
mod mesh;
#[cfg(feature = "mikktspace")]
mod mikktspace;
mod normal;
mod parallax;
mod parametric;
mod relief;
mod slopes;
mod tangent;
mod unit;
mod vector;

pub use displacement::{Grid, MeshBuffers, Subdivision, displace, displaced, displaced_mesh};
pub use height::{HeightMap, bilinear_height, bilinear_height_lanes};
pub use material::{
    Wettable, ambient_occlusion, ambient_occlusion_lanes, blinn_phong, blinn_phong_cosine_lanes,
    blinn_phong_lanes, lambert, lambert_lanes, phong, phong_cosine_lanes, phong_lanes, power,
    power_each_lanes, power_lanes, shininess, shininess_lanes, wet_lanes,
};
pub use mesh::{LengthError, frame_of_tangent, vertex_normals, vertex_tangents};
#[cfg(feature = "mikktspace")]
pub use mikktspace::mikktspace;
pub use normal::{
    NormalEncoding, normal, normal_lanes, normal_of_two, normal_of_two_lanes, normal_to_parent, strengthened,
    strengthened_lanes, to_parent_lanes,
};
pub use parallax::{
    AnyParallax, LimitedParallax, OffsetParallax, ParallaxOcclusion, ParallaxSearch, SteepParallax,
};
pub use parametric::{Cylinder, Differences, Parametric, Plane, Sphere, Torus};
pub use relief::{Relief, bump, bump_lanes, normal_of_slope, normal_of_slope_lanes};
pub use slopes::{BilinearHeights, CentralDifferences};
pub use tangent::{
    Tangent, frame_of_derivatives, frame_of_normal, orthonormal, triangle_directions, triangle_frame,
};
pub(crate) use vector::has_range;
pub use vector::{absolute_lanes, clamped_lanes, dot_lanes, unit_lanes};
