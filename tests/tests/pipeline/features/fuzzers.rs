//! `arbitrary`: values of a fuzzer's bytes are such as constructors make, and whatever they are, drawing is infallible.

use alberti::glam::Vec3;
use alberti::raster::color::{AnyBlend, Blended, Rgb332};
use alberti::shaders::Solid;
use alberti::*;
use alberti_oracle::rng::Rng;
use arbitrary::{Arbitrary, Unstructured};
use std::collections::BTreeSet;

fn bytes(rng: &mut Rng, count: usize) -> Vec<u8> {
    (0..count).map(|_| rng.u64().to_le_bytes()[0]).collect()
}

/// Values of random bytes.
fn values<T: for<'a> Arbitrary<'a>>(count: u64) -> impl Iterator<Item = T> {
    (0..count).map(|index| {
        let bytes = bytes(&mut Rng::stream(7, index), 64);
        T::arbitrary(&mut Unstructured::new(&bytes)).expect("64 bytes are enough for any")
    })
}

#[test]
fn all_choices_occur() {
    let kinds = |names: &mut dyn Iterator<Item = String>| names.collect::<BTreeSet<_>>().len();
    assert_eq!(kinds(&mut values::<AnyDepth>(200).map(|value| format!("{value:?}"))), 6);
    assert_eq!(kinds(&mut values::<Cull>(200).map(|value| format!("{value:?}"))), 3);
    assert_eq!(
        kinds(
            &mut values::<Profile<FixedPoint<Spans16>, Rgb332, OrEqual<D16>>>(9)
                .map(|value| format!("{value:?}"))
        ),
        2
    );
    // Seven lengths of spans, affine, and as many budgets as there are numbers.
    let lines =
        |name: &'static str| values::<Lines>(400).filter(move |lines| format!("{lines:?}").contains(name));
    assert!(kinds(&mut lines("budget: None").map(|lines| format!("{lines:?}"))) == 8);
    assert!(lines("Some").count() > 50);
}

#[test]
fn views_are_possible() {
    for lens in values::<Perspective>(2_000) {
        assert!(0.0 < lens.near() && lens.near() < lens.far() && lens.far().is_finite(), "{lens:?}");
        let [first, last] = [lens.near(), lens.far()].map(|z| lens.depth_map(false).zs(z));
        assert!(first.abs() < 1e-6 && (last - 1.0).abs() < 1e-6, "{lens:?}");
        let scaled = lens.scale(Point3::new(Vec3::ONE)).coords;
        assert!(scaled.x.is_normal() && scaled.y.is_normal() && scaled.min_element() > 0.0, "{lens:?}");
    }
    for lens in values::<Parallel>(2_000) {
        assert!(lens.near() < lens.far(), "{lens:?}");
    }
    for viewport in values::<Viewport>(2_000) {
        for side in viewport.pixels() {
            assert!(-16_384 <= side.start && side.start < side.end && side.end <= 16_384, "{viewport:?}");
        }
    }
}

#[test]
fn lights_grids_and_projectors_are_possible() {
    use alberti::shaders::material::{AnyLight, Directional};
    use alberti::texture::surface::{Grid, Subdivision};
    let length = |light: &Directional| {
        // What a light sends to the origin is its direction and its colour.
        let numbers = serde_json::to_value(light).expect("plain values")["to_light"].clone();
        let [x, y, z]: [f64; 3] = serde_json::from_value(numbers).expect("three numbers");
        (x * x + y * y + z * z).sqrt()
    };
    for light in values::<Directional>(2_000) {
        let length = length(&light);
        assert!(length == 0.0 || (length - 1.0).abs() < 1e-6, "{light:?}");
    }
    let kinds: BTreeSet<_> =
        values::<AnyLight>(60).map(|light| format!("{light:?}")[..5].to_owned()).collect();
    assert_eq!(kinds.len(), 3, "{kinds:?}");
    for (grid, part) in values::<Grid>(2_000).zip(values::<Subdivision>(2_000)) {
        let most = Grid::MAX_CELLS as usize;
        assert!(
            (4..=(most + 1) * (most + 1)).contains(&grid.vertices()) && grid.triangles() >= 2,
            "{grid:?}"
        );
        assert!((1..=Subdivision::MAX_PARTS).contains(&part.parts()), "{part:?}");
    }
    for projector in values::<Projector>(2_000) {
        let shown = projector.project(Point3::new(Vec3::ONE));
        assert!(shown.u.is_finite() && shown.v.is_finite() && shown.q.is_finite(), "{projector:?}");
    }
}

/// A place that is in view more often than not.
fn usual_place(rng: &mut Rng) -> Vec3 {
    #[expect(clippy::cast_possible_truncation, reason = "f32 by choice")]
    Vec3::from_array(std::array::from_fn(|_| rng.uniform(-2.0, 2.0) as f32))
}

/// Whatever a pass takes.
#[derive(Arbitrary, Debug)]
struct Input {
    view: View<AnyProjection>,
    place: Frame<Object, World>,
    vertices: [Vec3; 5],
    triangles: [[u8; 3]; 4],
    viewport: Viewport,
    cull: Cull,
    sides: Sides,
    subpixel: Subpixel,
    lines: Lines,
    depth: Biased<AnyDepth>,
    blend: AnyBlend,
    color: Rgba8,
}

#[test]
fn anything_can_be_drawn() {
    let mut drawn = 0;
    for index in 0..3_000 {
        let mut rng = Rng::stream(11, index);
        let bytes = bytes(&mut rng, 400);
        let mut input = Input::arbitrary(&mut Unstructured::new(&bytes)).expect("400 bytes are enough");
        // Places of any bits are mostly far out of view; half of them are replaced by usual ones.
        if index % 2 == 0 {
            let camera = Camera::look_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y).expect("a direction");
            input.view = camera.perspective(1.0, 0.1..9.0).expect("a view").into();
            input.place = Frame::IDENTITY;
            input.triangles = input.triangles.map(|corners| corners.map(|corner| corner % 5));
            input.viewport = Viewport::new(0, 0, 16, 12).expect("within reach");
            input.vertices = input.vertices.map(|_| usual_place(&mut rng));
        }
        let (mut color, mut depth) = ([7; 16 * 12], [0_u32; 16 * 12]);
        let mut target = Target::new(Rgba8888, input.depth, 16, 12, &mut color, &mut depth).expect("fits");
        let mesh = Mesh::new(&input.vertices, &input.triangles, |place| (*place, ()));
        let mut part = target.scissor(2..14, 3..9);
        let mut target = part.with_color(Blended { format: Rgba8888, by: input.blend });
        let stats = Pass::new(&input.view, &mesh, Solid(input.color))
            .at(input.place)
            .viewport(input.viewport)
            .cull(input.cull)
            .sides(input.sides)
            .subpixel(input.subpixel)
            .interpolation(input.lines)
            .draw_counted(&mut target);
        drawn += stats.drawn;
        let inside = |k: usize| (2..14).contains(&(k % 16)) && (3..9).contains(&(k / 16));
        assert!(color.iter().enumerate().all(|(k, pixel)| inside(k) || *pixel == 7), "{input:?}");
    }
    assert!(drawn > 1_000, "{drawn}");
}
