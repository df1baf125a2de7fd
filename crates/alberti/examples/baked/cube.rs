// Made by `alberti bake` of the built-in scene `cube`: 12 triangles, 8 vertices.

/// The mesh of part 0: 8 vertices, 12 triangles, meshlets: 1.
#[allow(dead_code, reason = "a program may need only some")]
pub fn mesh_0() -> impl alberti::Geometry<Varying = alberti::glam::Vec3> {
    use alberti::glam::Vec3;
    use alberti::{Ball, IntegerMesh, IntegerVertex, Meshlets, Q16};
    let stage = |&(place, color): &([i16; 3], [u8; 3])| {
        let color = color.map(|byte: u8| Q16::from_bits(i32::from(byte) * 257));
        IntegerVertex::<Vec3> { place, components: color }
    };
    let mesh = IntegerMesh::new(&VERTICES_0, &TRIANGLES_0, 3.051851e-5, stage);
    let ball = Ball { center: Vec3::new(0.0, 0.0, 0.0), radius: 1.7320508 };
    Meshlets { mesh, meshlets: &MESHLETS_0, ball }
}

/// The colour of part 0, or a factor of its texture's.
#[allow(dead_code, reason = "a program may need only some")]
pub const COLOR_0: alberti::Rgba8 = alberti::Rgba8::from_bits(0xffffffff);

#[allow(dead_code, reason = "a program may need only some")]
static VERTICES_0: [([i16; 3], [u8; 3]); 8] = [
    ([32767, -32767, -32767], [255, 0, 0]), ([32767, 32767, -32767], [255, 255, 0]),
    ([32767, 32767, 32767], [255, 255, 255]), ([-32767, 32767, -32767], [0, 255, 0]),
    ([32767, -32767, 32767], [255, 0, 255]), ([-32767, 32767, 32767], [0, 255, 255]),
    ([-32767, -32767, -32767], [0, 0, 0]), ([-32767, -32767, 32767], [0, 0, 255]),
];
#[allow(dead_code, reason = "a program may need only some")]
static TRIANGLES_0: [[u16; 3]; 12] = [
    [0, 1, 2], [3, 2, 1], [0, 2, 4], [3, 5, 2], [6, 1, 0], [6, 3, 1], [6, 0, 4], [6, 5, 3], [7, 4, 2], [6, 4, 7],
    [7, 2, 5], [6, 7, 5],
];
#[allow(dead_code, reason = "a program may need only some")]
static MESHLETS_0: [alberti::Meshlet; 1] = [
    alberti::Meshlet {
        triangles: [0, 12], center: [0, 0, 0], radius: 8195,
        axis: [0, 0, 0], squared_sine: 65535, depths: [400, 32767],
    },
];
