//! The built-in scenes as flat arrays, in the form in which every peer takes them.

use crate::stones::Stones;
use crate::{Size, pavement};
use alberti_app::options::{Cull, Filter, Shading, Wrap};
use alberti_app::scene::Image;
use alberti_app::scenes::{BuiltIn, by_name};

/// The scenes that are timed: the name of the benchmark, the built-in scene, and the filter.
pub const SCENES: [(&str, &str, Filter); 5] = [
    ("fill", "fill", Filter::Nearest),
    ("fill-bilinear", "fill", Filter::Bilinear),
    ("mesh", "mesh", Filter::Nearest),
    ("gouraud", "gouraud", Filter::Nearest),
    ("floor", "floor", Filter::Nearest),
];

/// A scene in world space. All scenes here cull back faces and repeat their texture.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The benchmark's name for it.
    pub name: &'static str,
    /// What it was made from.
    pub built_in: BuiltIn,
    /// One for each vertex.
    pub positions: Vec<[f32; 3]>,
    /// Texture coordinates in texels, from the top left corner, none of them negative: peers without a floor function
    /// on their fast path may truncate.
    pub texels: Vec<[f32; 2]>,
    /// Red, green and blue in 0..=255.
    pub colors: Vec<[f32; 3]>,
    /// Counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// The one texture, in scenes that have one.
    pub texture: Option<Texture>,
    /// The maps of the [`pavement`], whose colours are the texture.
    pub stones: Option<Stones>,
}

impl Scene {
    /// A scene of [`SCENES`].
    ///
    /// # Panics
    /// When the application no longer has such a scene, or has changed it beyond what this module expects.
    #[must_use]
    pub fn load((name, built_in, filter): (&'static str, &str, Filter)) -> Self {
        let built_in = by_name(built_in).expect("a built-in scene");
        Self::new(name, BuiltIn { filter, ..built_in })
    }

    /// The [`pavement`], under a light.
    #[must_use]
    pub fn normal_mapped() -> Self {
        let stones = Stones::new();
        Self { stones: Some(stones.clone()), ..Self::new("normal-mapped", pavement::scene(&stones)) }
    }

    /// The scene of that name.
    ///
    /// # Panics
    /// When the application has made it otherwise than this module expects.
    #[must_use]
    pub fn new(name: &'static str, built_in: BuiltIn) -> Self {
        assert!(
            built_in.cull == Cull::Back && built_in.wrap == Wrap::Repeat,
            "{name}: other culling or wrapping"
        );
        let model = &built_in.model;
        let triangles = model.parts.iter().flat_map(|part| part.triangles.iter().copied()).collect();
        let textured = built_in.shading == Shading::Unlit;
        assert!(textured || built_in.shading == Shading::VertexColor, "{name}: a shading that peers lack");
        let texture = textured.then(|| Texture::new(&model.textures[0]));
        let texels = texture.as_ref().map_or_else(Vec::new, |texture| {
            let size = [texture.width as f32, texture.height as f32];
            let uv = model.vertices.iter().map(|v| [v.uv[0], 1.0 - v.uv[1]]);
            // Whole repeats, so that the picture stays the same.
            let low = uv.clone().fold([0.0_f32; 2], |low, uv| [low[0].min(uv[0]), low[1].min(uv[1])]);
            uv.map(|uv| [0, 1].map(|i| (uv[i] - low[i].floor()) * size[i])).collect()
        });
        Self {
            name,
            positions: model.vertices.iter().map(|v| v.position).collect(),
            texels,
            colors: model.vertices.iter().map(|v| v.color.map(|c| c * 255.0)).collect(),
            triangles,
            texture,
            stones: None,
            built_in,
        }
    }

    /// The colour of pixels that nothing covers.
    #[must_use]
    pub fn background(&self) -> [u8; 4] {
        let [r, g, b] = self.built_in.background;
        [r, g, b, 255]
    }

    /// Row by row, the matrix from world space to clip space: x to the right, y up, and within the view volume all
    /// three between -w and w.
    #[must_use]
    pub fn clip_from_world(&self, size: Size) -> [[f32; 4]; 4] {
        let camera = &self.built_in.camera;
        let [eye, target, up] = [camera.eye, camera.target, camera.up].map(|v| v.map(f64::from));
        let forward = unit([0, 1, 2].map(|i| target[i] - eye[i]));
        let right = unit(cross(forward, up));
        let up = cross(right, forward);
        let [near, far] = [camera.near, camera.far].map(f64::from);
        let focal = 1.0 / (f64::from(camera.fov).to_radians() / 2.0).tan();
        let row = |axis: [f64; 3], k: f64, offset: f64| {
            [axis[0] * k, axis[1] * k, axis[2] * k, offset - k * dot(axis, eye)].map(|c| c as f32)
        };
        let aspect = f64::from(size.width) / f64::from(size.height);
        [
            row(right, focal / aspect, 0.0),
            row(up, focal, 0.0),
            row(forward, (far + near) / (far - near), -2.0 * far * near / (far - near)),
            row(forward, 1.0, 0.0),
        ]
    }
}

/// A texture whose sides are powers of two, and the two ways to read it that peers are given. They are written once so
/// that no peer has a better one.
#[derive(Clone, Debug)]
pub struct Texture {
    width: u32,
    height: u32,
    shift: u32,
    data: Vec<[u8; 4]>,
}

impl Texture {
    fn new(image: &Image) -> Self {
        assert!(image.width.is_power_of_two() && image.height.is_power_of_two(), "peers repeat by masks");
        Self {
            width: image.width,
            height: image.height,
            shift: image.width.trailing_zeros(),
            data: image.texels.clone(),
        }
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The texels, rows from the top.
    #[must_use]
    pub fn data(&self) -> &[[u8; 4]] {
        &self.data
    }

    #[inline(always)]
    fn texel(&self, x: i32, y: i32) -> [u8; 4] {
        let (x, y) = (x as u32 & (self.width - 1), y as u32 & (self.height - 1));
        self.data[((y << self.shift) | x) as usize]
    }

    /// The texel at `[u, v]`, in texels, not negative.
    #[inline(always)]
    #[must_use]
    pub fn nearest(&self, [u, v]: [f32; 2]) -> [u8; 4] {
        self.texel(u as i32, v as i32)
    }

    /// The weighted mean of the four texels around `[u, v]`, in texels, not negative. Weights have 8 bits.
    #[inline(always)]
    #[must_use]
    pub fn bilinear(&self, [u, v]: [f32; 2]) -> [u8; 4] {
        // Half a texel back, and one whole repeat on, so that truncation still rounds down.
        let (u, v) = (
            ((u + (self.width as f32 - 0.5)) * 256.0) as i32,
            ((v + (self.height as f32 - 0.5)) * 256.0) as i32,
        );
        let (x, y, fx, fy) = (u >> 8, v >> 8, u as u32 & 255, v as u32 & 255);
        let [a, b, c, d] = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|(x, y)| self.texel(x, y));
        let weights = [(256 - fx) * (256 - fy), fx * (256 - fy), (256 - fx) * fy, fx * fy];
        std::array::from_fn(|i| {
            let [a, b, c, d] = [a[i], b[i], c[i], d[i]].map(u32::from);
            ((a * weights[0] + b * weights[1] + c * weights[2] + d * weights[3] + 0x8000) >> 16) as u8
        })
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|c| c / dot(a, a).sqrt())
}
