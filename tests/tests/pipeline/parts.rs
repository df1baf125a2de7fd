//! Small parts of the interface, each against arithmetic that is written out, or against what it stands for.

use alberti::baked::Attributes;
use alberti::glam::{Mat4, Vec2, Vec3};
use alberti::math::{Frame2, Point2};
use alberti::raster::{Corner, Numbers, Outcome};
use alberti::shaders::Ready565;
use alberti::shaders::Solid;
use alberti::texture::format::{Rgb565Alpha, TexelFormat as _};
use alberti::texture::surface::{Subdivision, displaced, normal_of_slope, shininess};
use alberti::texture::{AnyWrap, Border, Clamp, Mirror, Repeat, TextureError, Wrap};
use alberti::{
    Always, AnyDepth, Ball, Biased, Camera, Counters, Cull, D16, D24, D32, DepthFormat, Error, F32,
    F32Reversed, Geometry, Handedness, Lines, Memory, Mesh, NoDepth, Object, Pass, Point3, Q16, Rgb565Be,
    Rgba8, Rgba8888, Stats, Sub8, Target, TargetError, Touched, Vector3, ViewError,
};
use alberti_oracle::rng::{Rng, run_seed};

/// Both of two counters hear of all, and threads' counts are added to each.
#[test]
fn two_counters_hear_the_same() {
    fn tell(counters: &mut impl Counters) {
        counters.submitted();
        counters.submitted();
        counters.clipped();
        counters.dropped();
        counters.rasterized(Outcome::Missed);
        counters.touched(Outcome::Drawn, || [3..7, 2..9]);
        counters.span(5, 4);
    }
    let (mut stats, mut touched) = (Stats::default(), Touched::default());
    let mut both = (stats, touched.clone());
    tell(&mut stats);
    tell(&mut touched);
    tell(&mut both);
    assert_eq!(both, (stats, touched.clone()));
    assert_eq!([stats.submitted, stats.clipped, stats.dropped, stats.missed], [2, 1, 1, 1]);
    assert_eq!([touched.columns(), touched.rows()], [3..7, 2..9]);
    let mut twice = (Stats::default(), Touched::default());
    twice.add(both.clone());
    twice.add(both);
    assert_eq!((twice.0.submitted, twice.0.fragments, twice.0.written), (4, 10, 8));
    assert_eq!(twice.1, touched);
}

/// A format that is chosen at run time stores what the typed one does, and no later depth before an earlier one; so do
/// those with a bias of 0 and with another comparison.
#[test]
fn integer_depths_are_those_of_each_format_and_in_order() {
    fn same<D: DepthFormat<Stored = S>, S: Copy + PartialEq + core::fmt::Debug>(
        format: D,
        any: AnyDepth,
        widened: impl Fn(S) -> u32,
        [low, high]: [u32; 2],
    ) {
        let stored = |zs: u32| format.encode_integer(zs);
        for zs in [low, high] {
            assert_eq!(any.encode_integer(zs), widened(stored(zs)), "{any:?} {zs}");
            assert_eq!(
                Biased { format, constant: 0.0, slope: 0.0, clamp: 0.0 }.encode_integer(zs),
                stored(zs),
                "{any:?} {zs}"
            );
            assert_eq!(Always(format).encode_integer(zs), stored(zs), "{any:?} {zs}");
        }
        // The far one of two is never nearer.
        let (near, far) = if any.reversed() { (high, low) } else { (low, high) };
        assert!(!format.nearer(stored(far), stored(near)) || near == far, "{any:?} {near} {far}");
        assert!(!any.nearer(any.encode_integer(far), any.encode_integer(near)), "{any:?} {near} {far}");
    }
    let mut rng = Rng::stream(run_seed(), 3);
    for k in 0..20_000 {
        let mut pair = [(); 2].map(|()| u32::try_from(rng.index(1 << 31)).expect("31 bits"));
        if k == 0 {
            pair = [0, (1 << 31) - 1];
        }
        pair.sort_unstable();
        same(D16, AnyDepth::D16, u32::from, pair);
        same(D24, AnyDepth::D24, |word| word, pair);
        same(D32, AnyDepth::D32, |word| word, pair);
        same(F32, AnyDepth::F32, f32::to_bits, pair);
        same(F32Reversed, AnyDepth::F32Reversed, |depth| !depth.to_bits(), pair);
    }
    assert_eq!(AnyDepth::NoDepth.encode_integer(7), 0);
    assert!(NoDepth.nearer((), ()));
}

/// Each component becomes the nearest of the words that RGB565 has, by one shift.
#[test]
fn components_that_are_ready_become_the_nearest_words() {
    for bits in 0..=65_536 {
        let c = Q16::from_bits(bits);
        let ready = Ready565::of_integers([c; 3]);
        for (ready, steps) in ready.into_iter().zip([32_i64, 64, 32]) {
            let word = (i64::from(ready.to_bits()) * steps) >> 16;
            // The distance to the component times the greatest word, in 131072nds.
            let off = 2 * (word * 65_536 - i64::from(bits) * (steps - 1));
            assert!(off.abs() <= 65_536 + 2 * steps, "{bits}: {word} of {steps}");
        }
    }
    let [low, high] = [Q16::from_bits(-5), Q16::from_f32(7.5)];
    let ends = [Q16::ZERO, Q16::ONE];
    assert_eq!(
        [low, high].map(|c| Ready565::of_integers([c; 3])),
        ends.map(|c| Ready565::of_integers([c; 3]))
    );
}

/// A wrap mode that is chosen at run time is the typed one.
#[test]
fn wraps_of_any_kind_are_those_they_name() {
    fn same(any: AnyWrap, typed: impl Wrap) {
        let mut rng = Rng::stream(run_seed(), 4);
        assert_eq!(any.border(), typed.border());
        for _ in 0..2_000 {
            #[expect(clippy::cast_possible_truncation, reason = "any number")]
            let u = rng.uniform(-3.0, 3.0) as f32;
            let size = 1 + u32::try_from(rng.index(40)).expect("small");
            let reduced = typed.reduce(u);
            assert_eq!(any.reduce(u), reduced, "{any:?} {u}");
            let cell = typed.cell(reduced, size);
            assert_eq!(any.cell(reduced, size), cell, "{any:?} {u} {size}");
            assert!(cell < size || cell == u32::MAX, "{any:?} {u} {size}");
            let i = i32::try_from(rng.index(size as usize + 1)).expect("small") - 1;
            let [left, right] = [i, i + 1].map(|i| typed.index(i, size));
            assert_eq!(any.neighbours(i, size), (left, right), "{any:?} {i} {size}");
        }
    }
    same(AnyWrap::Repeat, Repeat);
    same(AnyWrap::Clamp, Clamp);
    same(AnyWrap::Mirror, Mirror);
    same(AnyWrap::Border(Rgba8::WHITE), Border(Rgba8::WHITE));
}

/// As many vertices as there are places of whole numbers in a triangle of that side.
#[test]
fn parts_of_a_triangle_are_counted() {
    for n in 1..20_u32 {
        let counted = (0..=n).flat_map(|row| 0..=n - row).count();
        assert_eq!(Subdivision::new(n).vertices(), counted);
    }
}

/// Moves, slopes and exponents of simple numbers are exact.
#[test]
fn surfaces_of_simple_numbers_are_exact() {
    let (point, up) = (Point3::<Object>::new(Vec3::new(1.0, 2.0, 3.0)), Vector3::new(Vec3::Y));
    assert_eq!(displaced(point, up, 0.5).coords, Vec3::new(1.0, 2.5, 3.0));
    assert_eq!(normal_of_slope(Vec2::ZERO).coords, Vec3::Z);
    let steep = normal_of_slope(Vec2::new(0.75, 0.0)).coords;
    assert!((steep - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-6, "{steep}");
    assert_eq!([0.0, 0.5, 1.0, f32::NAN, 7.0].map(|m| shininess(m, [10, 20])), [10, 15, 20, 10, 20]);
}

/// Texels of a constant are those that the format encodes.
#[test]
fn texels_of_a_constant_are_encoded() {
    const COLORS: [[u8; 4]; 3] = [[255, 0, 0, 128], [1, 2, 3, 255], [0; 4]];
    const TEXELS: [u32; 3] = Rgb565Alpha::of(&COLORS);
    assert_eq!(Rgb565Alpha::of(&std::hint::black_box(COLORS)), TEXELS, "of an image that is read");
    assert_eq!(TEXELS, COLORS.map(|[r, g, b, a]| Rgb565Alpha.encode(Rgba8::new(r, g, b, a))));
    assert_eq!(Rgb565Alpha.decode(TEXELS[2]).to_bytes(), [0; 4]);
}

/// The sets of attributes, and frames at a point.
#[test]
fn sets_and_frames_are_those_they_are_made_of() {
    let both = Attributes::UV | Attributes::NORMAL;
    assert!(both.contains(Attributes::UV) && both.contains(Attributes::NORMAL));
    assert!(!both.contains(Attributes::COLOR) && Attributes::UV.with(Attributes::NORMAL) == both);
    let origin = Point2::<Object>::new(Vec2::new(3.0, -4.0));
    let point = Frame2::<Object, Object>::at(origin).to_parent(Point2::new(Vec2::new(1.0, 2.0)));
    assert_eq!(point.coords, Vec2::new(4.0, -2.0));
    assert_eq!((Q16::from_f32(1.5) - Q16::from_f32(0.25)).to_f32(), 1.25);
    assert_eq!(format!("{:?}", Q16::from_f32(0.5)), "32768/65536");
}

/// A budget of texels is one of coordinates.
#[test]
fn budgets_of_texels_are_shares_of_a_side() {
    assert_eq!(Lines::bounded_texels(0.5, 64), Lines::bounded(0.5 / 64.0));
    assert_eq!(Lines::bounded_texels(0.5, 0), Lines::bounded(0.5));
}

/// A mesh that says no more than it must.
struct Bare;

impl Geometry for Bare {
    type Varying = ();

    fn triangles(&self) -> usize {
        1
    }

    fn triangle(&self, number: usize) -> Option<[usize; 3]> {
        (number == 0).then_some([0, 1, 2])
    }

    fn vertex(&self, number: usize) -> Option<(Point3<Object>, ())> {
        CORNERS.get(number).map(|&corner| (corner.into(), ()))
    }
}

const CORNERS: [Vec3; 3] =
    [Vec3::new(-1.0, -1.0, -4.0), Vec3::new(1.0, -0.5, -3.0), Vec3::new(0.25, 1.0, -5.0)];

/// What a mesh does not say is that nothing is known: vertices are transformed where triangles need them.
#[test]
fn a_bare_mesh_is_drawn_as_any_other() {
    assert_eq!((Bare.vertices(), Bare.unit(), Bare.integers(0).is_none()), (usize::MAX, 1.0, true));
    assert!(Bare.meshlet(0).is_none() && Bare.ball() == Ball::EVERYTHING);
    fn drawn(mesh: &impl Geometry<Varying = ()>) -> Vec<u32> {
        let (mut color, mut depth) = (vec![0; 40 * 30], vec![1.0; 40 * 30]);
        let mut target = Target::new(Rgba8888, F32, 40, 30, &mut color, &mut depth).expect("a target");
        let view = camera().perspective(1.0, 0.5..20.0).expect("a view");
        Pass::new(&view, mesh, Solid(Rgba8::WHITE)).cull(Cull::None).draw(&mut target);
        color
    }
    let usual = drawn(&Mesh::new(&CORNERS, &[[0_u16, 1, 2]], |&v| (v, ())));
    assert!(usual.iter().any(|&word| word != 0) && drawn(&Bare) == usual);
}

fn camera() -> Camera {
    Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y).expect("a camera")
}

/// The corners that a triangle is drawn with are where `f64` projects them, to half a subpixel, and come clockwise from
/// the topmost; of a triangle outside there are none.
#[test]
fn triangles_on_the_screen_are_projected() {
    let lens = alberti::Perspective::new(1.0, 4.0 / 3.0, 0.5, 20.0).expect("a lens");
    let turned = Camera::from_matrix(Mat4::IDENTITY, Handedness::Right).expect("a camera");
    let outside = CORNERS.map(|corner| -corner);
    let both = [CORNERS, outside].concat();
    let mesh = Mesh::new(&both, &[[0_u16, 1, 2], [3, 4, 5]], |&v: &Vec3| (v, ()));
    for view in [camera().through(lens), turned.through(lens)] {
        let pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE));
        let mut found = Vec::new();
        pass.on_screen([400, 300], F32, 0, |corners| {
            let drawn = Corner::as_drawn(corners, Numbers::Float, Sub8).expect("an area");
            found.push((corners.map(|corner| *corner), drawn));
        });
        let [(corners, drawn)] = found.as_slice() else { panic!("one triangle, found {}", found.len()) };
        let place = |corner: &Corner<()>| corner.place(false).map(|c| f64::from(c) / 256.0);
        let half = 150.0 / (0.5_f64).tan();
        for (corner, point) in corners.iter().zip(CORNERS) {
            let [x, y, z] = point.to_array().map(f64::from);
            let exact = [200.0 - x / z * half, 150.0 + y / z * half];
            let off = [0, 1].map(|k: usize| (place(corner)[k] - exact[k]).abs());
            assert!(off.iter().all(|off| *off <= 0.5 / 256.0 + 1e-3), "{off:?}");
        }
        let [a, b, c] = [0, 1, 2].map(|k: usize| place(&drawn[k]));
        assert!(a[1] <= b[1] && a[1] <= c[1], "{a:?} {b:?} {c:?}");
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(area > 0.0, "clockwise, as y goes down: {area}");
        let flat = [&corners[0], &corners[0], &corners[1]];
        assert!(Corner::as_drawn(flat, Numbers::Float, Sub8).is_none());
        pass.on_screen([400, 300], F32, 1, |_| panic!("it is behind the eye"));
        pass.on_screen([400, 300], F32, 2, |_| panic!("there is none"));
    }
}

/// Memory of a renderer holds one pixel and one depth everywhere, and is as large as its parts.
#[test]
fn memory_is_as_large_as_it_says() {
    type Small = Memory<Rgb565Be, D16, (), 64, 0, 0>;
    const MEMORY: Small = Small::new(0x1234, 7);
    let Memory { colors, depths, .. } = MEMORY;
    assert!(colors.iter().flatten().all(|&pixel| pixel == 0x1234) && depths == [7; 64]);
    let Memory { colors, depths, .. } = Small::new(std::hint::black_box(5), 9);
    assert!(colors.iter().flatten().all(|&pixel| pixel == 5) && depths == [9; 64]);
    assert_eq!(Small::BYTES, 64 * (2 * 2 + 2));
    Small::must_fit(Small::BYTES);
    let told = std::panic::catch_unwind(|| Small::must_fit(383)).expect_err("one byte more");
    let told = told.downcast_ref::<String>().expect("a text");
    assert_eq!(told, "the renderer's memory takes 384 bytes, 1 more than 383");
}

/// Each error says something of its own, in a line without an end, with the numbers that it has.
#[test]
fn errors_say_what_is_wrong() {
    let views = [
        ViewError::NotFinite,
        ViewError::EyeAtTarget,
        ViewError::UpAlongView,
        ViewError::Angle,
        ViewError::Aspect,
        ViewError::Height,
        ViewError::NearFar,
        ViewError::Viewport,
        ViewError::DepthRange,
        ViewError::Matrix,
    ];
    let targets = [
        TargetError::Size,
        TargetError::Rows { pixels: 81, width: 82 },
        TargetError::Color { found: 81, expected: 82 },
        TargetError::Stride { stride: 81, width: 82 },
        TargetError::Depth { found: 81, expected: 82 },
        TargetError::Coverage { found: 81, expected: 82 },
    ];
    let textures = [
        TextureError::ZeroSize { width: 81, height: 82 },
        TextureError::TooLarge { width: 81, height: 82 },
        TextureError::Length { found: 81, expected: 82 },
    ];
    let numbered =
        targets[1..].iter().map(ToString::to_string).chain(textures.iter().map(ToString::to_string));
    for text in numbered {
        assert!(text.contains("81") && text.contains("82"), "{text}");
    }
    let plain: Vec<String> = (views.iter().map(ToString::to_string))
        .chain(targets.iter().map(ToString::to_string))
        .chain(textures.iter().map(ToString::to_string))
        .collect();
    let all = (views.into_iter().map(Error::from))
        .chain(targets.into_iter().map(Error::from))
        .chain(textures.into_iter().map(Error::from));
    let told: Vec<String> = all.map(|error| error.to_string()).collect();
    assert_eq!(told, plain);
    let mut distinct = told.clone();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), told.len(), "{told:?}");
    for text in told {
        assert!(text.starts_with(|c: char| c.is_lowercase() || c.is_ascii_digit()), "{text}");
        assert!(!text.ends_with('.') && text.lines().count() == 1, "{text}");
    }
}

/// Values that hold others tell their name, and of long ones how many they are.
#[test]
fn values_tell_of_themselves() {
    let view = camera().perspective(1.0, 0.5..20.0).expect("a view");
    let mesh = Mesh::new(&CORNERS, &[[0_u16, 1, 2]], |&v: &Vec3| (v, ()));
    assert_eq!(format!("{mesh:?}"), "Mesh { vertices: 3, triangles: 1, .. }");
    let pass = format!("{:?}", Pass::new(&view, &mesh, Solid(Rgba8::WHITE)));
    assert!(pass.starts_with("Pass { view: View") && pass.contains("cull: "), "{pass}");
    let texels = [Rgba8::WHITE.to_bits(); 5].map(u32::to_ne_bytes);
    let texture = alberti::texture::Mipmap::new(Rgba8888, &texels, 2, 2).expect("a mip map");
    let told = format!("{texture:?}");
    assert!(told.starts_with("Mipmap { width: 2, height: 2, levels: 2"), "{told}");
    let sampler = format!("{:?}", texture.sampler(alberti::texture::Trilinear, Repeat));
    assert!(sampler.starts_with("MipSampler { mipmap: Mipmap") && sampler.contains("Repeat"), "{sampler}");
}
