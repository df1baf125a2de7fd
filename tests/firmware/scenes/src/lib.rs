//! The scenes that are drawn on the boards and, for the comparison, on the host: one source, the same bits.
//!
//! A new scene is a line of [`SCENES`], a new way of drawing a function beside [`flat`]. All numbers come from
//! IEEE operations and from shapes that are made at compile time (see [`shapes`]), so that nothing depends on a
//! platform's mathematical library.

#![no_std]

mod draws;
pub mod shapes;

pub use draws::{flat, flat_without_depth, gouraud, textured};
pub use shapes::PROBE;

use alberti::glam::Vec2;
use alberti::{D16, DepthFormat, Perspective, Slot, Stats, Sub4, ViewError, Viewport};
use shapes::{Model, TORUS_VERTICES, layers, torus};

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
    /// How it is drawn: this is what is measured.
    pub draw: Draw<()>,
    /// The same, counting.
    pub count: Draw<Stats>,
}

/// All scenes.
///
/// In the fills every layer is nearer than those before it and covers the frame, so each writes every pixel.
pub static SCENES: &[Scene] = &[
    Scene { name: "flat", model: layers(1), draw: flat, count: flat },
    Scene { name: "flat-4", model: layers(4), draw: flat, count: flat },
    Scene { name: "flat-no-depth", model: layers(1), draw: flat_without_depth, count: flat_without_depth },
    Scene { name: "flat-no-depth-4", model: layers(4), draw: flat_without_depth, count: flat_without_depth },
    Scene { name: "gouraud", model: layers(1), draw: gouraud, count: gouraud },
    Scene { name: "gouraud-4", model: layers(4), draw: gouraud, count: gouraud },
    Scene { name: "textured", model: layers(1), draw: textured, count: textured },
    Scene { name: "textured-4", model: layers(4), draw: textured, count: textured },
    Scene { name: "mesh", model: torus(1.0), draw: textured, count: textured },
    Scene { name: "mesh-eighth", model: torus(0.125), draw: textured, count: textured },
];

/// What all scenes are seen through.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    perspective: Perspective,
    viewport: Viewport,
}

impl Camera {
    /// A right angle from bottom to top, over the whole frame.
    ///
    /// # Errors
    /// None.
    pub fn new() -> Result<Self, ViewError> {
        Ok(Self {
            perspective: Perspective::new(core::f32::consts::FRAC_PI_2, shapes::ASPECT, 0.5, 50.0)?,
            viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?,
        })
    }
}

/// The memory of a frame: colour in little-endian RGB565, depth in 16 bits, and the transformed vertices.
#[derive(Debug)]
pub struct Target {
    color: [u16; PIXELS],
    depth: [u16; PIXELS],
    slots: [Slot<Sub4, Vec2>; TORUS_VERTICES],
}

impl Target {
    /// Memory as it is before the start.
    pub const EMPTY: Self =
        Self { color: [0; PIXELS], depth: [0; PIXELS], slots: [Slot::EMPTY; TORUS_VERTICES] };

    /// Makes all pixels dark grey and as far away as can be.
    pub fn clear(&mut self) {
        self.color.fill(0x2104_u16.to_le());
        self.depth.fill(D16::FARTHEST);
    }

    /// The 64-bit FNV-1a hash of the colour's bytes, then the depth's, low byte first.
    #[must_use]
    pub fn hash(&self) -> u64 {
        let color = self.color.iter().flat_map(|pixel| pixel.to_ne_bytes());
        let depth = self.depth.iter().flat_map(|depth| depth.to_le_bytes());
        color
            .chain(depth)
            .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    /// The colours, row by row from the top, as they lie in memory.
    #[must_use]
    pub fn color(&self) -> &[u16] {
        &self.color
    }
}
