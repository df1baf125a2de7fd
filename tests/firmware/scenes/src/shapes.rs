//! The meshes and the texture, made at compile time, so that they lie in flash.
//!
//! Positions are in the eye's orientation: x right, y up, z away.

use crate::torus::{
    COARSE_TRIANGLE_LIST, HalfWords, TORUS_IN_HALF_WORDS, TORUS_TRIANGLE_LIST, TORUS_VERTEX_LIST, Vertex,
    part,
};
use crate::{HEIGHT, WIDTH};
use alberti::glam::{Mat3, Vec3};
use alberti::texture::{
    Known, Mipmap, PowerOfTwo, Texture,
    format::{L8, Rgb565, Rgb565Alpha, Rgb565Pairs},
};
use alberti::{Ball, Eye, Frame, Meshlet, Point3, Rgba8, Rgba565, World};

/// Width by height of the frame.
#[expect(clippy::cast_precision_loss, reason = "small integers")]
pub const ASPECT: f32 = WIDTH as f32 / HEIGHT as f32;

/// What a scene shows.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    /// The mesh's vertices.
    pub vertices: &'static [Vertex],
    /// The same in integers, where a scene wants them.
    pub integers: &'static [HalfWords],
    /// Three indices each, counter-clockwise as seen from the front.
    pub triangles: &'static [[u16; 3]],
    /// The same triangles in the order of meshlets, where a scene wants these; and a ball around them.
    pub meshlets: (&'static [[u16; 3]], &'static [Meshlet], Ball),
    /// The mesh's place before the eye.
    pub to_eye: Frame<World, Eye>,
}

/// So many tilted quads over the whole frame and a quarter beyond, each nearer than those before it.
#[must_use]
pub const fn layers(count: usize) -> Model {
    Model {
        vertices: QUADS.split_at(4 * count).0,
        integers: &[],
        triangles: QUAD_TRIANGLES.split_at(2 * count).0,
        meshlets: NO_MESHLETS,
        to_eye: Frame::IDENTITY,
    }
}

/// A torus that is so many times its size, tilted by the angle of the triangle with the sides 3, 4 and 5.
#[must_use]
pub const fn torus(size: f32) -> Model {
    let axes = Mat3::from_cols(
        Vec3::new(size, 0.0, 0.0),
        Vec3::new(0.0, 0.6 * size, 0.8 * size),
        Vec3::new(0.0, -0.8 * size, 0.6 * size),
    );
    Model {
        vertices: &TORUS_VERTEX_LIST,
        integers: &TORUS_IN_HALF_WORDS,
        triangles: &TORUS_TRIANGLE_LIST,
        meshlets: (&TORUS_MESHLETS.0, &TORUS_MESHLETS.1, TORUS_MESHLETS.2),
        to_eye: Frame::from_mat3(axes, Point3::new(Vec3::new(0.0, 0.0, 2.35))),
    }
}

/// The same farther away, for a longer lens: a little larger on the screen, and as good as without perspective.
#[must_use]
pub const fn distant_torus() -> Model {
    let Model { to_eye, .. } = torus(1.0);
    let axes = to_eye.axes();
    Model { to_eye: Frame::from_mat3(axes, Point3::new(Vec3::new(0.0, 0.0, 6.4))), ..torus(1.0) }
}

/// The same in triangles that are four times as long and as wide.
#[must_use]
pub const fn coarse_torus() -> Model {
    Model { triangles: &COARSE_TRIANGLE_LIST, ..torus(1.0) }
}

/// A plane that rises from below the frame to a distance of 40, in strips that are as high as one another on the
/// screen: its texels are from twice to a 40th as large as pixels, and at most as long as wide.
#[must_use]
pub const fn floor() -> Model {
    Model {
        vertices: &FLOOR_VERTICES,
        integers: &[],
        triangles: &FLOOR_TRIANGLES,
        meshlets: NO_MESHLETS,
        to_eye: Frame::IDENTITY,
    }
}

/// What the floor wears, made by the build script.
pub static FLOOR_MIPMAP: Mipmap<'static, Rgb565, PowerOfTwo> = {
    static TEXELS: [u16; alberti::texture::mipmap::texel_count(64, 64)] =
        include!(concat!(env!("OUT_DIR"), "/floor.rs"));
    let Ok(mipmap) = Mipmap::new(Rgb565, &TEXELS, 64, 64) else {
        panic!("the levels of a square of this side")
    };
    let Some(mipmap) = mipmap.power_of_two() else { panic!("its side is a power of two") };
    mipmap
};

/// The same with neighbours.
pub static FLOOR_PAIRS: Mipmap<'static, Rgb565Pairs, PowerOfTwo> = {
    const COUNT: usize = alberti::texture::mipmap::texel_count(64, 64);
    static PAIRS: [u32; COUNT] = Rgb565Pairs::of(&include!(concat!(env!("OUT_DIR"), "/floor.rs")), 64, 64);
    let Ok(mipmap) = Mipmap::new(Rgb565Pairs, &PAIRS, 64, 64) else {
        panic!("the levels of a square of this side")
    };
    let Some(mipmap) = mipmap.power_of_two() else { panic!("its side is a power of two") };
    mipmap
};

/// What models wear that have no mip map.
pub static TEXTURE: Texture<'static, Rgb565, Known<128, 128>> = {
    let Ok(texture) = Texture::new(Rgb565, &CHEQUER, 128, 128) else {
        panic!("the texels are a square of this side")
    };
    let Some(texture) = texture.known() else { panic!("its side is this") };
    texture
};

/// The low bytes of its texels: places in a palette.
pub static INDICES: Texture<'static, L8, Known<128, 128>> = {
    static BYTES: [u8; 128 * 128] = {
        let (mut bytes, mut at) = ([0; 128 * 128], 0);
        while at < bytes.len() {
            bytes[at] = CHEQUER[at].to_le_bytes()[0];
            at += 1;
        }
        bytes
    };
    let Ok(texture) = Texture::new(L8, &BYTES, 128, 128) else {
        panic!("the texels are a square of this side")
    };
    let Some(texture) = texture.known() else { panic!("its side is this") };
    texture
};

/// The texels of [`TEXTURE`], as opaque as they are green.
pub static GLASS: Texture<'static, Rgb565Alpha, Known<128, 128>> = {
    static WORDS: [u32; 128 * 128] = {
        let (mut words, mut at) = ([0; 128 * 128], 0);
        while at < words.len() {
            let texel = CHEQUER[at] as u32;
            // As the format's decoder has them.
            let [r, g, b] = [texel >> 11, texel >> 5 & 63, texel & 31];
            let [r, g, b] = [r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2];
            words[at] = Rgba565::new(Rgba8::from_bits(g << 24 | b << 16 | g << 8 | r)).to_bits();
            at += 1;
        }
        words
    };
    let Ok(texture) = Texture::new(Rgb565Alpha, &WORDS, 128, 128) else {
        panic!("the texels are a square of this side")
    };
    let Some(texture) = texture.known() else { panic!("its side is this") };
    texture
};

/// The chequer with neighbours.
pub static CHEQUER_PAIRS: Texture<'static, Rgb565Pairs, Known<128, 128>> = {
    static PAIRS: [u32; 128 * 128] = Rgb565Pairs::of(&CHEQUER, 128, 128);
    let Ok(texture) = Texture::new(Rgb565Pairs, &PAIRS, 128, 128) else {
        panic!("the texels are a square of this side")
    };
    let Some(texture) = texture.known() else { panic!("its side is this") };
    texture
};

const NO_MESHLETS: (&[[u16; 3]], &[Meshlet], Ball) = (&[], &[], Ball::EVERYTHING);

// The torus in meshlets, made by the build script.
include!(concat!(env!("OUT_DIR"), "/meshlets.rs"));

/// What the programs draw whose size alone is of interest: one quad, and no byte more.
pub static PROBE: Model = {
    static CORNERS: [Vertex; 4] = *quads().first_chunk().expect("four and more");
    static TRIANGLES: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
    Model { vertices: &CORNERS, triangles: &TRIANGLES, ..layers(1) }
};

/// The most layers that there are.
const LAYERS: usize = 4;

static QUADS: [Vertex; 4 * LAYERS] = quads();

const fn quads() -> [Vertex; 4 * LAYERS] {
    let corners = [[-1.25, -1.25], [1.25, -1.25], [1.25, 1.25], [-1.25, 1.25]];
    let tilts = [[0.04, 0.024], [-0.04, 0.024], [-0.04, -0.024], [0.04, -0.024]];
    let colors = [[1.0, 0.9, 0.2], [0.1, 0.8, 0.3], [0.2, 0.3, 1.0], [0.9, 0.1, 0.4]];
    let mut vertices = [Vertex::ZERO; 4 * LAYERS];
    // How near the layer is in the middle: one over its distance, which is linear on the screen.
    let mut middle = 0.15;
    let mut layer = 0;
    while layer < LAYERS {
        let mut k = 0;
        while k < 4 {
            let [x, y] = corners[k];
            let q = middle + tilts[layer][0] * x + tilts[layer][1] * y;
            let position = [x * ASPECT / q, y / q, 1.0 / q];
            let uv = [position[0] * 0.5, position[1] * 0.5];
            vertices[4 * layer + k] = Vertex { position, color: colors[(k + layer) % 4], uv };
            k += 1;
        }
        middle += 0.2;
        layer += 1;
    }
    vertices
}

static QUAD_TRIANGLES: [[u16; 3]; 2 * LAYERS] = {
    let mut triangles = [[0; 3]; 2 * LAYERS];
    let (mut layer, mut first) = (0, 0);
    while layer < LAYERS {
        triangles[2 * layer] = [first, first + 1, first + 2];
        triangles[2 * layer + 1] = [first, first + 2, first + 3];
        layer += 1;
        first += 4;
    }
    triangles
};

const STRIPS: u16 = 16;

static FLOOR_VERTICES: [Vertex; 2 * (STRIPS as usize + 1)] = {
    let mut vertices = [Vertex::ZERO; 2 * (STRIPS as usize + 1)];
    let (mut at, mut strip) = (0, 0);
    while strip <= STRIPS {
        let q = 1.1 + (0.025 - 1.1) * part(strip, STRIPS);
        let z = 1.0 / q;
        let mut side = -1.0;
        while side < 2.0 {
            let position = [1.25 * ASPECT * side * z, 0.9 * z - 1.9, z];
            vertices[at] = Vertex { position, color: [0.5; 3], uv: [0.5 * position[0], 0.67 * z] };
            at += 1;
            side += 2.0;
        }
        strip += 1;
    }
    vertices
};

static FLOOR_TRIANGLES: [[u16; 3]; 2 * STRIPS as usize] = {
    let mut triangles = [[0; 3]; 2 * STRIPS as usize];
    let (mut at, mut left) = (0, 0);
    while at < triangles.len() {
        triangles[at] = [left, left + 1, left + 3];
        triangles[at + 1] = [left, left + 3, left + 2];
        at += 2;
        left += 2;
    }
    triangles
};

/// 128 by 128 texels; the squares are told apart by their colours.
static CHEQUER: [u16; 128 * 128] = {
    let mut texels = [0; 128 * 128];
    let (mut at, mut y) = (0, 0_u16);
    while y < 128 {
        let mut x = 0;
        while x < 128 {
            let dark = (x / 16 + y / 16) % 2;
            let (red, green, blue) = (x / 4, y / 2, 31 - (x ^ y) / 4);
            texels[at] = (red >> dark) << 11 | (green >> dark) << 5 | blue >> dark;
            at += 1;
            x += 1;
        }
        y += 1;
    }
    texels
};
