//! The reader of baked files: any bytes are refused, or all that the file says is there.

use crate::bits::Bits;
use alberti::baked::{Baked, BakedMesh, Color, Normal, Tangent, Uv};
use alberti::glam::Vec3;
use alberti::lanes::One;
use alberti::shaders::VertexColor;
use alberti::{Affine, Camera, Cull, D16, FixedPoint, Geometry as _, Pass, Point3, Rgb565Le, Target, View};

pub(crate) fn run(bytes: &[u8]) {
    read(bytes);
    // A sound file with changes, as random bytes are hardly ever one.
    let mut bits = Bits::new(bytes);
    let mut file = SOUND.to_vec();
    for _ in 0..1 + bits.below(6) {
        let at = bits.below(file.len());
        file[at] = bits.byte();
    }
    if bits.byte() < 32 {
        file.truncate(bits.below(file.len()));
    }
    read(&file);
}

/// A cube with all attributes, meshlets and a texture of four bits, as `alberti bake --scene cube` writes it.
const SOUND: &[u8] = include_bytes!("../cube.bin");

fn read(bytes: &[u8]) {
    let Ok(file) = Baked::read(bytes) else { return };
    assert!(file.unit() > 0.0 && file.unit().is_finite());
    let mut number = 0;
    while let Some(texels) = file.texture(number) {
        let _ = format!("{texels:?}");
        number += 1;
    }
    let camera = Camera::look_at(Vec3::new(1.0, 2.0, 4.0), Vec3::ZERO, Vec3::Y).expect("a direction");
    let view = camera.perspective(0.8, 0.1..50.0).expect("a pyramid");
    for part in file.parts() {
        assert!(part.texture().is_none_or(|texture| texture < number));
        let _ = part.color();
        macro_rules! all {
            ($($attributes:ty),*) => {$(
                if let Ok(mesh) = part.mesh::<$attributes>() {
                    for vertex in 0..mesh.vertices().min(400) {
                        let (place, carried) = mesh.vertex(vertex).expect("a vertex that is counted");
                        // Of a greater unit places may be infinite, and their triangles are left out.
                        let place = if file.unit() > 1e34 { Point3::new(Vec3::ZERO) } else { place };
                        assert!(place.coords.is_finite() && alberti_math::is_finite(carried));
                    }
                    for triangle in 0..mesh.triangles().min(400) {
                        let corners = mesh.triangle(triangle).expect("a triangle that is counted");
                        assert!(corners.iter().all(|&corner| corner < mesh.vertices()));
                    }
                }
            )*};
        }
        all!((), Uv, Normal, Tangent, Color, (Normal, Uv));
        if let Ok(mesh) = part.mesh::<Normal>()
            && mesh.triangles() < 2000
        {
            draw(&view, &mesh);
        }
    }
}

/// In integers, as a chip does.
fn draw(view: &View, mesh: &BakedMesh<'_, Normal>) {
    let (mut color, mut depth) = ([0; 24 * 16], [u16::MAX; 24 * 16]);
    let mut target = Target::new(Rgb565Le, D16, 24, 16, &mut color, &mut depth).expect("a frame");
    let mut pass = Pass::new(view, mesh, VertexColor).interpolation(FixedPoint(Affine)).cull(Cull::None);
    pass.draw_by(One, &mut target);
}
