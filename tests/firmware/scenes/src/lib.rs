//! The scenes that are drawn on the boards and, for the comparison, on the host: one source, the same bits.
//!
//! A new scene is a line of [`SCENES`], a new way of drawing a function beside [`flat`]. All numbers come from
//! IEEE operations and from shapes that are made at compile time (see [`shapes`]), so that nothing depends on a
//! platform's mathematical library.

#![no_std]

mod afterwards;
mod draws;
mod floor;
mod formats;
pub mod policies;
pub mod renderer;
pub mod shapes;
pub mod torus;

pub use afterwards::{
    alpha_dithered, alpha_tested, biased, cloud, dithered, fogged, hazy, hazy_stored, in_light, keyed,
    multiplied, noisy, premultiplied, sampled, sampled_in_light, smooth, smooth_in_light, squared, wireframe,
    wireframe_bands,
};
pub use draws::{
    additive_fixed, affine_fixed, affine_integers, affine_mesh, affine_mesh_sub8, affine_meshlets,
    bilinear_fixed, bilinear_pairs_fixed, bilinear_stored_fixed, bounded_bands, constant_fixed,
    dithered_affine_fixed, flat, flat_fixed, flat_integers, flat_mesh, flat_meshlets, flat_without_depth,
    glass_fixed, gouraud, gouraud_fixed, gouraud_mesh, gouraud_meshlets, integers_bands, material,
    material_absent, material_emission, meshlets_bands, meshlets_cache, over_fixed, over_stored_fixed,
    pairs_affine_fixed, textured, textured_affine, textured_bands, textured_bounded, textured_fixed,
    textured_meshlets, textured_planes, textured_spans,
};
pub use floor::{
    derived_fixed, dithered_bilinear_fixed, dithered_trilinear_fixed, leveled_bilinear_fixed, leveled_mesh,
    leveled_nearest_fixed, leveled_trilinear_fixed, lit_fixed, mesh_base_nearest, mesh_mip_nearest,
    mip_bilinear, mip_bilinear_fixed, mip_nearest, mip_nearest_fixed, one_level_fixed, one_level_mesh,
    pairs_bilinear_fixed, pairs_trilinear_fixed, trilinear, trilinear_fixed, trilinear_spans,
    trilinear_spans_fixed, trilinear_stored_fixed, trilinear_stored_spans_fixed,
};
pub use formats::{grey1, grey2, grey4, grey8, indexed, rgb332, rgb444, rgb666, rgb888, xrgb8888};
pub use renderer::{Renderer, meshlets_renderer};
pub use shapes::PROBE;

use alberti::glam::Vec2;
use alberti::shaders::Ready565;
use alberti::{D16, DepthFormat, Frame, Perspective, PreparedTriangle, Slot, View};
use shapes::{Model, coarse_torus, distant_torus, floor, layers, torus};
use torus::{TORUS_TRIANGLES, TORUS_VERTICES};

/// Columns of the frame.
pub const WIDTH: u32 = 320;
/// Rows of the frame.
pub const HEIGHT: u32 = 240;
/// Pixels of the frame.
pub const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// A way of drawing, for whoever counts.
pub type Draw<K> = fn(&mut Target, &Camera, &Model, &mut K);

/// One frame to draw.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// By what it is called in the reports: no spaces.
    pub name: &'static str,
    /// What is drawn.
    pub model: Model,
    /// What it is seen through.
    pub camera: Camera,
    /// How it is drawn: this is what is measured.
    pub draw: Draw<()>,
    /// The same, counting: on the host, since a board must not pay for it.
    #[cfg(feature = "std")]
    pub count: Draw<alberti::Stats>,
}

macro_rules! scene {
    ($name:literal, $model:expr, $draw:ident) => {
        scene!($name, $model, $draw, Camera::STEADY)
    };
    ($name:literal, $model:expr, $draw:ident, $camera:expr) => {
        Scene {
            name: $name,
            model: $model,
            camera: $camera,
            draw: $draw,
            #[cfg(feature = "std")]
            count: $draw,
        }
    };
}

macro_rules! fill {
    ($name:literal, $layers:literal, $draw:ident) => {
        scene!($name, layers($layers), $draw)
    };
}

/// All scenes.
///
/// In the fills every layer is nearer than those before it and covers the frame, so each writes every pixel.
pub static SCENES: &[Scene] = &[
    fill!("flat", 1, flat),
    fill!("flat-4", 4, flat),
    fill!("flat-no-depth", 1, flat_without_depth),
    fill!("flat-no-depth-4", 4, flat_without_depth),
    fill!("gouraud", 1, gouraud),
    fill!("gouraud-4", 4, gouraud),
    fill!("textured", 1, textured),
    fill!("textured-4", 4, textured),
    scene!("mesh", torus(1.0), textured),
    scene!("mesh-eighth", torus(0.125), textured),
    scene!("mesh-affine", torus(1.0), textured_affine),
    scene!("mesh-spans", torus(1.0), textured_spans),
    scene!("mesh-planes", torus(1.0), textured_planes),
    scene!("mesh-base-nearest", torus(1.0), mesh_base_nearest),
    scene!("mesh-mip-nearest", torus(1.0), mesh_mip_nearest),
    fill!("fixed-flat", 1, flat_fixed),
    fill!("fixed-flat-4", 4, flat_fixed),
    fill!("fixed-gouraud", 1, gouraud_fixed),
    fill!("fixed-gouraud-4", 4, gouraud_fixed),
    fill!("fixed-affine", 1, affine_fixed),
    fill!("fixed-affine-4", 4, affine_fixed),
    fill!("fixed-constant", 1, constant_fixed),
    fill!("fixed-constant-4", 4, constant_fixed),
    fill!("fixed-glass", 1, glass_fixed),
    fill!("fixed-glass-4", 4, glass_fixed),
    fill!("fixed-over", 1, over_fixed),
    fill!("fixed-over-4", 4, over_fixed),
    fill!("fixed-over-stored", 1, over_stored_fixed),
    fill!("fixed-over-stored-4", 4, over_stored_fixed),
    fill!("fixed-additive", 1, additive_fixed),
    fill!("fixed-additive-4", 4, additive_fixed),
    fill!("fixed-premultiplied", 1, premultiplied),
    fill!("fixed-multiply", 1, multiplied),
    fill!("fixed-in-light", 1, in_light),
    fill!("fixed-alpha-test", 1, alpha_tested),
    fill!("fixed-color-key", 1, keyed),
    fill!("fixed-alpha-dither", 1, alpha_dithered),
    fill!("fixed-fog-linear", 1, hazy),
    fill!("fixed-fog-exponential", 1, fogged),
    fill!("fixed-fog-squared", 1, squared),
    fill!("fixed-fog-stored", 1, hazy_stored),
    fill!("fixed-dither-bayer", 1, dithered),
    fill!("fixed-dither-noise", 1, noisy),
    fill!("fixed-rgb444", 1, rgb444),
    fill!("fixed-rgb666", 1, rgb666),
    fill!("fixed-rgb888", 1, rgb888),
    fill!("fixed-xrgb8888", 1, xrgb8888),
    fill!("fixed-rgb332", 1, rgb332),
    fill!("fixed-grey8", 1, grey8),
    fill!("fixed-grey4", 1, grey4),
    fill!("fixed-grey2", 1, grey2),
    fill!("fixed-grey1", 1, grey1),
    fill!("fixed-indexed", 1, indexed),
    fill!("fixed-textured", 1, textured_fixed),
    fill!("fixed-textured-4", 4, textured_fixed),
    fill!("fixed-bilinear", 1, bilinear_fixed),
    fill!("fixed-bilinear-4", 4, bilinear_fixed),
    fill!("fixed-bilinear-stored", 1, bilinear_stored_fixed),
    fill!("fixed-bilinear-stored-4", 4, bilinear_stored_fixed),
    fill!("fixed-bilinear-pairs", 1, bilinear_pairs_fixed),
    fill!("fixed-affine-pairs", 1, pairs_affine_fixed),
    fill!("fixed-affine-dither", 1, dithered_affine_fixed),
    scene!("fixed-mesh-flat", torus(1.0), flat_mesh),
    scene!("fixed-mesh-lines", coarse_torus(), wireframe),
    scene!("fixed-mesh-lines-bands", coarse_torus(), wireframe_bands),
    scene!("fixed-mesh-points", coarse_torus(), cloud),
    scene!("fixed-mesh-smooth", torus(1.0), smooth),
    scene!("fixed-mesh-smooth-light", torus(1.0), smooth_in_light),
    scene!("fixed-mesh-sampled", torus(1.0), sampled),
    scene!("fixed-mesh-sampled-light", torus(1.0), sampled_in_light),
    scene!("fixed-mesh-gouraud", torus(1.0), gouraud_mesh),
    scene!("fixed-mesh-affine", torus(1.0), affine_mesh),
    scene!("fixed-mesh-biased", torus(1.0), biased),
    scene!("fixed-mesh", torus(1.0), textured_fixed),
    scene!("fixed-mesh-sub8", torus(1.0), affine_mesh_sub8),
    scene!("fixed-mesh-coarse", coarse_torus(), affine_mesh),
    scene!("fixed-mesh-one-level", torus(1.0), one_level_mesh),
    scene!("fixed-mesh-leveled", torus(1.0), leveled_mesh),
    scene!("fixed-mesh-one-level-coarse", coarse_torus(), one_level_mesh),
    scene!("fixed-mesh-leveled-coarse", coarse_torus(), leveled_mesh),
    scene!("fixed-mesh-bands", torus(1.0), textured_bands),
    scene!("fixed-mesh-eighth", torus(0.125), textured_fixed),
    scene!("integer-mesh-flat", torus(1.0), flat_integers),
    scene!("integer-mesh-affine", torus(1.0), affine_integers),
    scene!("integer-mesh-eighth", torus(0.125), affine_integers),
    scene!("integer-mesh-bands", torus(1.0), integers_bands),
    scene!("meshlets-flat", torus(1.0), flat_meshlets),
    scene!("meshlets-affine", torus(1.0), affine_meshlets),
    scene!("meshlets-bands", torus(1.0), meshlets_bands),
    scene!("meshlets-bands-cache", torus(1.0), meshlets_cache),
    scene!("meshlets-renderer", torus(1.0), meshlets_renderer),
    scene!("fixed-mesh-bounded", torus(1.0), textured_bounded),
    scene!("meshlets-bands-bounded", torus(1.0), bounded_bands),
    scene!("meshlets-distant-flat", distant_torus(), flat_meshlets, Camera::LONG),
    scene!("meshlets-distant-gouraud", distant_torus(), gouraud_meshlets, Camera::LONG),
    scene!("meshlets-distant-affine", distant_torus(), affine_meshlets, Camera::LONG),
    scene!("meshlets-distant-spans", distant_torus(), textured_meshlets, Camera::LONG),
    scene!("meshlets-distant-bands", distant_torus(), meshlets_bands, Camera::LONG),
    fill!("material", 1, material),
    fill!("material-absent", 1, material_absent),
    fill!("material-emission", 1, material_emission),
    scene!("floor", floor(), textured),
    scene!("floor-mip-nearest", floor(), mip_nearest),
    scene!("floor-mip-bilinear", floor(), mip_bilinear),
    scene!("floor-trilinear", floor(), trilinear),
    scene!("floor-trilinear-spans", floor(), trilinear_spans),
    scene!("fixed-floor", floor(), textured_fixed),
    scene!("fixed-floor-mip-nearest", floor(), mip_nearest_fixed),
    scene!("fixed-floor-mip-bilinear", floor(), mip_bilinear_fixed),
    scene!("fixed-floor-trilinear", floor(), trilinear_fixed),
    scene!("fixed-floor-trilinear-spans", floor(), trilinear_spans_fixed),
    scene!("fixed-floor-trilinear-stored", floor(), trilinear_stored_fixed),
    scene!("fixed-floor-trilinear-stored-spans", floor(), trilinear_stored_spans_fixed),
    scene!("fixed-floor-one-level", floor(), one_level_fixed),
    scene!("fixed-floor-derived", floor(), derived_fixed),
    scene!("fixed-floor-leveled-nearest", floor(), leveled_nearest_fixed),
    scene!("fixed-floor-lit", floor(), lit_fixed),
    scene!("fixed-floor-leveled-bilinear", floor(), leveled_bilinear_fixed),
    scene!("fixed-floor-leveled-trilinear", floor(), leveled_trilinear_fixed),
    scene!("fixed-floor-dither-bilinear", floor(), dithered_bilinear_fixed),
    scene!("fixed-floor-dither-trilinear", floor(), dithered_trilinear_fixed),
    scene!("fixed-floor-pairs-bilinear", floor(), pairs_bilinear_fixed),
    scene!("fixed-floor-pairs-trilinear", floor(), pairs_trilinear_fixed),
];

/// What a scene is seen through.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    perspective: Perspective,
}

impl Camera {
    /// A right angle from bottom to top, over the whole frame.
    pub const STEADY: Self = Self::of(core::f32::consts::FRAC_PI_2);

    /// 33 degrees.
    pub const LONG: Self = Self::of(0.58);

    /// The view of what stands before the eye.
    #[must_use]
    pub const fn view(self) -> View {
        View::new(Frame::IDENTITY, self.perspective)
    }

    const fn of(angle: f32) -> Self {
        match Perspective::new(angle, shapes::ASPECT, 0.5, 50.0) {
            Ok(perspective) => Self { perspective },
            Err(_) => panic!("a pyramid"),
        }
    }
}

/// The memory of a frame: colour in little-endian RGB565, depth in 16 bits, the transformed vertices, the list of the
/// triangles in bands, the words of a silhouette's band, the samples of a larger frame's band; that of a renderer in
/// bands; and colour in other formats.
#[derive(Debug)]
pub struct Target {
    color: [u16; PIXELS],
    depth: [u16; PIXELS],
    slots: Slots,
    listed: [PreparedTriangle; TORUS_TRIANGLES],
    cells: [i32; afterwards::CELLS],
    samples: ([u16; afterwards::SAMPLES], [u16; afterwards::SAMPLES]),
    renderer: Renderer,
    other: formats::Pixels,
}

/// Room for the vertices of the torus, by the attributes that they carry.
#[derive(Debug)]
struct Slots {
    bare: [Slot<()>; TORUS_VERTICES],
    colored: [Slot<Ready565>; TORUS_VERTICES],
    mapped: [Slot<Vec2>; TORUS_VERTICES],
}

impl Target {
    /// Memory as it is before the start.
    pub const EMPTY: Self = Self {
        color: [0; PIXELS],
        depth: [0; PIXELS],
        slots: Slots {
            bare: [Slot::EMPTY; TORUS_VERTICES],
            colored: [Slot::EMPTY; TORUS_VERTICES],
            mapped: [Slot::EMPTY; TORUS_VERTICES],
        },
        listed: [PreparedTriangle::EMPTY; TORUS_TRIANGLES],
        cells: [0; afterwards::CELLS],
        samples: ([0; afterwards::SAMPLES], [0; afterwards::SAMPLES]),
        renderer: renderer::EMPTY,
        other: formats::Pixels::EMPTY,
    };

    /// A pixel of nothing: dark grey.
    const BACKGROUND: u16 = 0x2104_u16.to_le();

    /// Makes all pixels dark grey and as far away as can be.
    pub fn clear(&mut self) {
        self.color.fill(Self::BACKGROUND);
        self.depth.fill(D16.farthest());
        self.other.clear();
    }

    /// The 64-bit FNV-1a hash of the colour's bytes, the depth's, low byte first, and those in another format.
    #[must_use]
    pub fn hash(&self) -> u64 {
        let color = self.color.iter().flat_map(|pixel| pixel.to_ne_bytes());
        let depth = self.depth.iter().flat_map(|depth| depth.to_le_bytes());
        color
            .chain(depth)
            .chain(self.other.drawn())
            .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    /// The colours, row by row from the top, as they lie in memory.
    #[must_use]
    pub fn color(&self) -> &[u16] {
        &self.color
    }
}
