//! Frames of all kinds are one picture: whole, as a window into a larger one, in [`Bands`] of the same memory, and with
//! the aspect ratio of the viewport or one that is given.
//!
//! One kernel, exact and with [`AnyDepth`], on many random sizes.
#![allow(clippy::cast_possible_truncation, reason = "random f64 become the f32 that are drawn")]

use alberti::glam::Vec3;
use alberti::{
    AnyDepth, Bands, Camera, ColorFormat, Cull, DepthFormat, Mesh, Parallel, Pass, Perspective, Point3,
    PreparedTriangle, Projection, Rgb565Be, Rgba8, Rgba8888, Target, Vector3, View, Viewport, look_at,
};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::for_widest;
use alberti_tests::narrow::Narrow;

/// A pixel that nobody draws.
const SENTINEL: u32 = 0xdead_beef;
const DEPTH: AnyDepth = AnyDepth::D24;

/// Triangles through each other before an eye in the origin that looks along −z, some of them across planes of the
/// view.
struct Soup(Vec<Vec3>, Vec<[u16; 3]>);

impl Soup {
    fn new(rng: &mut Rng) -> Self {
        let mut at = |most: f64| rng.uniform(-most, most) as f32;
        let vertices = (0..60).map(|_| Vec3::new(at(4.0), at(4.0), at(3.0) - 2.5)).collect();
        Self(vertices, (0..20).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
    }

    /// Draws it, in a viewport or in the whole frame.
    fn draw<C: ColorFormat>(
        &self,
        target: &mut Target<'_, C, AnyDepth>,
        view: &View<impl Projection>,
        viewport: Option<Viewport>,
    ) {
        let mesh = Mesh::new(&self.0, &self.1, |&p| (p, p));
        let pass = Pass::new(view, &mesh, Narrow(stage)).cull(Cull::None);
        let mut pass = if let Some(viewport) = viewport { pass.viewport(viewport) } else { pass };
        for_widest!(lanes => pass.draw_by(lanes, target));
    }

    /// Its colours and depths in a whole frame.
    fn picture(
        &self,
        [width, height]: [u32; 2],
        view: &View<impl Projection>,
        viewport: Option<Viewport>,
    ) -> [Vec<u32>; 2] {
        let pixels = (width * height) as usize;
        let (mut color, mut depth) = (vec![0; pixels], vec![DEPTH.farthest(); pixels]);
        let mut target =
            Target::new(Rgba8888, DEPTH, width, height, &mut color, &mut depth).expect("a frame");
        self.draw(&mut target, view, viewport);
        [color, depth]
    }
}

/// A colour of every bit of the varying.
fn stage(v: Vec3) -> Option<Rgba8> {
    let bits = v.to_array().map(f32::to_bits);
    Some(Rgba8::from_bits(bits[0] ^ bits[1].rotate_left(9) ^ bits[2].rotate_left(21)))
}

fn camera() -> Camera {
    Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y).expect("a direction")
}

fn view() -> View {
    camera().perspective(1.1, 0.3..5.0).expect("a pyramid")
}

fn any_size(rng: &mut Rng) -> [u32; 2] {
    [(); 2].map(|()| u32::try_from(rng.range(1, 90)).expect("a small number"))
}

#[test]
fn a_window_shows_the_frame_and_nothing_beside_it() {
    let mut rng = Rng::stream(run_seed(), 1);
    let mut drawn = 0;
    for _ in 0..400 {
        let (soup, view, size) = (Soup::new(&mut rng), view(), any_size(&mut rng));
        let [color, depth] = soup.picture(size, &view, None);
        let [width, height] = size.map(|n| n as usize);
        // To the left, to the right, and above; below there may be nothing, not even the end of the last row.
        let [left, right, above] = [(); 3].map(|()| rng.index(20));
        let stride = left + width + right;
        let corner = above * stride + left;
        let below = if rng.one_in(2) { 0 } else { right + rng.index(3) * stride };
        let mut picture = vec![SENTINEL; corner + (height - 1) * stride + width + below];
        let mut its_depth = vec![DEPTH.farthest(); depth.len()];
        let memory = &mut picture[corner..];
        let mut window = Target::window(Rgba8888, DEPTH, size, 0..size[1], stride, memory, &mut its_depth)
            .expect("a window");
        // Cleared to the colour of pixels that no triangle covers in the frame.
        window.clear(0u32);
        soup.draw(&mut window, &view, None);
        assert!(its_depth == depth, "{size:?} in rows of {stride}");
        for (place, &pixel) in picture.iter().enumerate() {
            let (row, column) = ((place / stride).wrapping_sub(above), (place % stride).wrapping_sub(left));
            let expected =
                if row < height && column < width { color[row * width + column] } else { SENTINEL };
            assert_eq!(pixel, expected, "{size:?} in rows of {stride}: pixel {column}, {row}");
        }
        drawn += color.iter().filter(|&&pixel| pixel != 0).count();
    }
    assert!(drawn > 100_000, "{drawn}");
}

#[test]
fn bands_in_the_same_memory_make_the_frame() {
    let mut rng = Rng::stream(run_seed(), 2);
    for _ in 0..150 {
        let (soup, view, size) = (Soup::new(&mut rng), view(), any_size(&mut rng));
        let [width, height] = size.map(|n| n as usize);
        let (mut color, mut depth) = (vec![0; width * height], vec![0; width * height]);
        let mut target = Target::new(Rgb565Be, DEPTH, size[0], size[1], &mut color, &mut depth).expect("one");
        target.clear(Rgba8::BLACK);
        soup.draw(&mut target, &view, None);

        let rows = 1 + rng.index(height + 3);
        let (mut memory, mut its_depth) = (vec![0; width * rows], vec![0; width * rows]);
        let mesh = Mesh::new(&soup.0, &soup.1, |&p| (p, p));
        let mut pass = Pass::new(&view, &mesh, Narrow(stage)).cull(Cull::None);
        let mut room = vec![PreparedTriangle::EMPTY; rng.index(40)];
        let (mut prepared, _) = pass.count_prepare(size, DEPTH, &mut room, &mut ());
        for again in [false, true] {
            let mut bands =
                Bands::new(Rgb565Be, DEPTH, size[0], size[1], &mut memory, &mut its_depth).expect("bands");
            assert_eq!(bands.size(), size);
            let mut frame = Vec::new();
            while let Some(mut band) = bands.next_band() {
                band.clear(Rgba8::BLACK);
                if again {
                    prepared.draw(&mut band);
                } else {
                    soup.draw(&mut band, &view, None);
                }
                frame.extend_from_slice(band.pixels());
            }
            assert!(frame == color, "{size:?} in bands of {rows} rows, prepared: {again}");

            // The depths of a band for all colours of the frame.
            let mut frame = vec![0x1234; width * height];
            let mut bands =
                Bands::new(Rgb565Be, DEPTH, size[0], size[1], &mut frame, &mut its_depth).expect("bands");
            bands.draw(Rgba8::BLACK, |band| {
                if again {
                    prepared.draw(band);
                } else {
                    soup.draw(band, &view, None);
                }
            });
            assert!(frame == color, "{size:?} over bands of {rows} rows, prepared: {again}");
        }
    }
}

/// A camera's view has the aspect ratio of the viewport: of the frame, or of a part of it.
#[test]
fn views_of_cameras_are_as_wide_as_the_viewport() {
    let mut rng = Rng::stream(run_seed(), 3);
    let (eye, target) = (Point3::new(Vec3::ZERO), Point3::new(Vec3::NEG_Z));
    let to_eye = look_at(eye, target, Vector3::new(Vec3::Y)).expect("a direction").inverse_orthonormal();
    let mut drawn = 0;
    for i in 0..200 {
        let (soup, frame) = (Soup::new(&mut rng), any_size(&mut rng));
        let (angle, height) = (rng.uniform(0.2, 2.5) as f32, rng.uniform(0.5, 9.0) as f32);
        let part = any_size(&mut rng);
        let [x, y] = [(); 2].map(|()| i32::try_from(rng.range(-40, 40)).expect("a small number"));
        let viewport = (i % 2 == 0).then(|| Viewport::new(x, y, part[0], part[1]).expect("a viewport"));
        let [across, down] = if viewport.is_some() { part } else { frame };
        let aspect = (f64::from(across) / f64::from(down)) as f32;

        let fitting = camera().perspective(angle, 0.3..5.0).expect("a pyramid");
        let given = View::new(to_eye, Perspective::new(angle, aspect, 0.3, 5.0).expect("a pyramid"));
        let expected = soup.picture(frame, &given, viewport);
        assert!(soup.picture(frame, &fitting, viewport) == expected, "{frame:?}, {viewport:?}");

        let fitting = camera().parallel(height, 0.3..5.0).expect("a box");
        let given = View::new(to_eye, Parallel::new(height, aspect, 0.3, 5.0).expect("a box"));
        let parallel = soup.picture(frame, &given, viewport);
        assert!(soup.picture(frame, &fitting, viewport) == parallel, "{frame:?}, {viewport:?}");
        drawn +=
            [&expected[0], &parallel[0]].map(|color| color.iter().filter(|&&pixel| pixel != 0).count())[0];
    }
    assert!(drawn > 20_000, "{drawn}");
}
