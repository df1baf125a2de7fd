//! The object, and how it stands and is lit in a frame.

use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::shaders::{Light, Lit565, Stored};
use alberti::texture::format::Rgb565;
use alberti::texture::{Leveled, MipSampler, Mipmap, Nearest, NearestLevel, PowerOfTwo, Repeat};
use alberti::*;

/// A vertex, as it lies in flash.
pub(crate) struct Vertex {
    /// In 2^-14.
    place: [i16; 3],
    /// In 127ths.
    normal: [i8; 3],
    /// In 4096ths of the texture.
    uv: [u16; 2],
}

include!(concat!(env!("OUT_DIR"), "/object.rs"));

/// The unit of places.
const UNIT: f32 = 1.0 / 16384.0;

/// The light that comes from everywhere, in 2^-16, and that which comes from one side.
const LIGHT: [i32; 2] = [22000, 43536];

static TEXTURE: Mipmap<'static, Rgb565, PowerOfTwo> = match Mipmap::new(Rgb565, &TEXELS, SIDE, SIDE) {
    Ok(texture) => texture.power_of_two().expect("sides that are"),
    Err(_) => panic!("as many texels as all levels have"),
};

/// The texel that is nearest in the level that is.
static TEXELS_OF_LEVELS: MipSampler<'static, Rgb565, NearestLevel<Nearest>, Repeat, Repeat, PowerOfTwo> =
    TEXTURE.sampler(NearestLevel(Nearest), Repeat);

/// The lens, so that the board computes none of it.
const LENS: Perspective = match Perspective::new(0.7, panel::WIDTH as f32 / panel::HEIGHT as f32, 1.0, 8.0) {
    Ok(lens) => lens,
    Err(_) => panic!("an impossible lens"),
};

/// Where everything is in a frame.
pub(crate) struct Scene {
    view: View,
    frame: Frame<Object, World>,
    /// The direction to the light in the object's space, for normals in 127ths and a cosine in 2^-16.
    to_light: [i32; 3],
}

type Texels = Lit565<Stored<Leveled<'static, Rgb565, NearestLevel<Nearest>, Repeat, Repeat, PowerOfTwo>>>;

impl Scene {
    /// The scene after so many frames.
    pub(crate) fn at(frame: u32) -> Self {
        // Columns are the object's axes: a slow turn about the vertical, a quicker one about its own axis.
        let turned = turn_y(frame) * turn_z(frame.wrapping_mul(2));
        let to_light = turned.transpose() * Vec3::new(-0.48, 0.64, 0.6);
        Self {
            // The eye is three units before the origin, and sees what is before it along its z.
            view: View::new(
                Frame::from_mat3(Mat3::from_diagonal(Vec3::new(1.0, 1.0, -1.0)), Point3::new(Vec3::Z * 3.0)),
                LENS,
            ),
            frame: Frame::from_mat3(turned, Point3::new(Vec3::ZERO)),
            to_light: to_light.to_array().map(|c| (c * (65536.0 / 127.0)) as i32),
        }
    }

    /// The mesh under the light of this frame.
    pub(crate) fn mesh(&self) -> impl Geometry<Varying = (Light, Vec2)> {
        let [x, y, z] = self.to_light;
        IntegerMesh::new(&VERTICES, &TRIANGLES, UNIT, move |vertex: &Vertex| {
            let [nx, ny, nz] = vertex.normal.map(i32::from);
            let cosine = (nx * x + ny * y + nz * z).max(0);
            let light = Q16::from_bits(LIGHT[0] + ((cosine * (LIGHT[1] >> 8)) >> 8));
            let uv = vertex.uv.map(|c| Q16::from_bits(i32::from(c) << 4));
            IntegerVertex::<(Light, Vec2)> { place: vertex.place, components: (Light::of_integer(light), uv) }
        })
    }

    /// The pass that draws it.
    pub(crate) fn pass<'a, M: Geometry>(&'a self, mesh: &'a M) -> Pass<'a, M, Texels, Exact> {
        let texels = Stored(TEXELS_OF_LEVELS.leveled());
        Pass::new(&self.view, mesh, Lit565 { surface: texels }).subpixel(Sub4).at(self.frame)
    }
}

/// Sine and cosine of so many 256ths of a turn.
fn sin_cos(turn: u32) -> [f32; 2] {
    [turn, turn + 64].map(|turn| SINES[(turn % 256) as usize])
}

fn turn_y(turn: u32) -> Mat3 {
    let [sin, cos] = sin_cos(turn);
    Mat3::from_cols(Vec3::new(cos, 0.0, -sin), Vec3::Y, Vec3::new(sin, 0.0, cos))
}

fn turn_z(turn: u32) -> Mat3 {
    let [sin, cos] = sin_cos(turn);
    Mat3::from_cols(Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0), Vec3::Z)
}
