//! The torus. Its circles are made by the rational parametrisation ((1 - t²)/(1 + t²), 2t/(1 + t²)), as sines and
//! cosines would differ between platforms. The build script divides it into meshlets, and so has this file too.

/// All that the ways of drawing may carry.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// In object space.
    pub position: [f32; 3],
    /// Red, green and blue in [0, 1].
    pub color: [f32; 3],
    /// In textures: 1 is a whole one.
    pub uv: [f32; 2],
}

impl Vertex {
    /// Nothing yet.
    pub const ZERO: Self = Self { position: [0.0; 3], color: [0.0; 3], uv: [0.0; 2] };
}

/// A vertex in integers.
#[derive(Clone, Copy, Debug)]
pub struct HalfWords {
    /// In units of 2^-14.
    pub position: [i16; 3],
    /// In units of 2^-12.
    pub uv: [u16; 2],
    /// In 255ths.
    pub color: [u8; 3],
}

impl HalfWords {
    /// The unit of positions.
    pub const UNIT: f32 = 1.0 / 16384.0;

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in range")]
    const fn of(Vertex { position: [x, y, z], color: [r, g, b], uv: [u, v] }: Vertex) -> Self {
        let position = [(x / Self::UNIT) as i16, (y / Self::UNIT) as i16, (z / Self::UNIT) as i16];
        let color = [(r * 255.0) as u8, (g * 255.0) as u8, (b * 255.0) as u8];
        Self { position, uv: [(u * 4096.0) as u16, (v * 4096.0) as u16], color }
    }
}

/// Cells of the torus along its ring, and around its tube: multiples of four, for the quarters of a circle.
const ALONG: u16 = 92;
const AROUND: u16 = 32;
/// Radius of the ring and of the tube.
const RADII: [f32; 2] = [1.0, 0.45];

/// Vertices of the torus: those of the seams are there twice, for their texture coordinates.
pub const TORUS_VERTICES: usize = (ALONG as usize + 1) * (AROUND as usize + 1);
/// Triangles of the torus.
pub const TORUS_TRIANGLES: usize = 2 * ALONG as usize * AROUND as usize;

/// Its vertices.
pub static TORUS_VERTEX_LIST: [Vertex; TORUS_VERTICES] = {
    let mut vertices = [Vertex::ZERO; TORUS_VERTICES];
    let (mut at, mut i) = (0, 0);
    while i <= ALONG {
        let [ring_x, ring_y] = circle(i, ALONG);
        let mut j = 0;
        while j <= AROUND {
            let [out, up] = circle(j, AROUND);
            let radius = RADII[0] + RADII[1] * out;
            let position = [radius * ring_x, radius * ring_y, RADII[1] * up];
            let color = [0.5 + 0.5 * ring_x, 0.5 + 0.5 * ring_y, 0.5 + 0.5 * up];
            vertices[at] = Vertex { position, color, uv: [6.0 * part(i, ALONG), 2.0 * part(j, AROUND)] };
            at += 1;
            j += 1;
        }
        i += 1;
    }
    vertices
};

/// The same in integers.
pub static TORUS_IN_HALF_WORDS: [HalfWords; TORUS_VERTICES] = {
    let mut vertices = [HalfWords::of(Vertex::ZERO); TORUS_VERTICES];
    let mut at = 0;
    while at < TORUS_VERTICES {
        vertices[at] = HalfWords::of(TORUS_VERTEX_LIST[at]);
        at += 1;
    }
    vertices
};

/// Three indices each.
pub static TORUS_TRIANGLE_LIST: [[u16; 3]; TORUS_TRIANGLES] = cells(1);

/// Its triangles when cells are four times as long and as wide.
pub static COARSE_TRIANGLE_LIST: [[u16; 3]; TORUS_TRIANGLES / 16] = cells(4);

/// Two triangles for each cell of so many steps along and around.
const fn cells<const COUNT: usize>(step: u16) -> [[u16; 3]; COUNT] {
    let mut triangles = [[0; 3]; COUNT];
    let row = step * (AROUND + 1);
    let (mut at, mut i) = (0, 0);
    while i < ALONG / step {
        let mut j = 0;
        while j < AROUND {
            let first = i * row + j;
            triangles[at] = [first, first + row + step, first + row];
            triangles[at + 1] = [first, first + step, first + row + step];
            at += 2;
            j += step;
        }
        i += 1;
    }
    triangles
}

/// The point `i` of `count` on the unit circle, the last being the first: equal steps of t in each quarter.
const fn circle(i: u16, count: u16) -> [f32; 2] {
    let quarter = count / 4;
    let t = part(i % quarter, quarter);
    let (x, y) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    match i / quarter % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// A part of the whole.
pub const fn part(i: u16, count: u16) -> f32 {
    i as f32 / count as f32
}
