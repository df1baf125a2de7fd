//! Meshlets that are left out, against the facing and the place of each of their triangles in `f64`.

use super::*;
use crate::view::View;
use crate::{Mesh, Pass, PreparedTriangle, Slot};
use alberti_math::glam::{DMat3, DVec3, Quat};
use alberti_math::{Rgba8, Rgba8888, World};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::{AnyProjection, Parallel, Perspective};
use alberti_raster::{F32, Target};
use core::f64::consts::PI;
use std::println;
use std::vec::Vec;

/// A closed surface of bumps, and its triangles, counter-clockwise as seen from outside.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "small, or rounded on purpose"
)]
fn bumps(rng: &mut Rng) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let [around, rows] = [8 + rng.index(24), 6 + rng.index(16)];
    let size = rng.log_uniform(1e-3, 1e3);
    let middle = Vec3::from_array([(); 3].map(|()| rng.uniform(-3.0, 3.0) as f32)) * size;
    let stretch = Vec3::from_array([(); 3].map(|()| rng.uniform(0.3, 1.0) as f32));
    let (depth, bumps) = (rng.uniform(0.0, 0.3), rng.uniform(1.0, 6.0));
    let places =
        (0..=rows).flat_map(|row| (0..around).map(move |column| (row, column))).map(|(row, column)| {
            let (a, b) = (row as f64 / rows as f64 * PI, column as f64 / around as f64 * 2.0 * PI);
            let radius = 1.0 + depth * (bumps * a).sin() * (bumps.round() * b).cos();
            let direction = DVec3::new(a.sin() * b.cos(), a.sin() * b.sin(), a.cos());
            (direction * radius).as_vec3() * stretch * size + middle
        });
    let number = |row: usize, column: usize| (row * around + column % around) as u32;
    let triangles = (0..rows).flat_map(|row| {
        (0..around).flat_map(move |column| {
            let [a, b] = [number(row, column), number(row, column + 1)];
            let [c, d] = [number(row + 1, column), number(row + 1, column + 1)];
            [[a, c, d], [a, d, b]]
        })
    });
    (places.collect(), triangles.collect())
}

/// A view in which some of it may be seen.
#[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
fn view(rng: &mut Rng, ball: &Ball) -> (View<AnyProjection>, Frame<Object, World>) {
    let turn = Quat::from_scaled_axis(Vec3::from_array([(); 3].map(|()| rng.uniform(-PI, PI) as f32)));
    let scale = Vec3::from_array([(); 3].map(|()| rng.log_uniform(0.2, 5.0)));
    let mirrored = if rng.one_in(4) { -1.0 } else { 1.0 };
    let axes = Mat3::from_quat(turn) * Mat3::from_diagonal(scale * Vec3::new(mirrored, 1.0, 1.0));
    let reach = ball.radius * scale.max_element();
    let aside = [(); 2].map(|()| rng.uniform(-1.0, 1.0) as f32 * reach);
    let place = Vec3::new(aside[0], aside[1], rng.log_uniform(0.3, 100.0) * reach) - axes * ball.center;
    let near = rng.log_uniform(1e-3, 0.5) * reach;
    let far = near * rng.log_uniform(3.0, 1e4);
    let projection = if rng.one_in(4) {
        Parallel::new(rng.log_uniform(1.0, 4.0) * reach, 1.0, near, far).expect("a box").into()
    } else {
        Perspective::new(rng.uniform(0.5, 2.7) as f32, 1.0, near, far).expect("a pyramid").into()
    };
    // The eye looks along z, and y goes up.
    let eye = Frame::from_mat3(Mat3::from_diagonal(Vec3::new(1.0, 1.0, -1.0)), Point3::new(Vec3::ZERO));
    let at = Frame::from_mat3(
        Mat3::from_diagonal(Vec3::new(1.0, 1.0, -1.0)) * axes,
        Point3::new(place * Vec3::new(1.0, 1.0, -1.0)),
    );
    (View::new(eye, projection), at)
}

/// A mesh that carries nothing.
type Bare<'a> = Mesh<'a, Vec3, u32, fn(&Vec3) -> (Vec3, ())>;

/// Places before an eye.
struct Scene<'a> {
    places: &'a [Vec3],
    triangles: &'a [[u32; 3]],
    mesh: &'a Meshlets<'a, Bare<'a>>,
    view: View<AnyProjection>,
    at: Frame<Object, World>,
    cull: Cull,
}

impl Scene<'_> {
    fn screen(&self) -> Screen<AnyProjection> {
        let pass = Pass::new(&self.view, self.mesh, |()| Some(Rgba8::WHITE)).at(self.at);
        pass.screen([300, 300], F32).expect("pixels")
    }

    fn sees(&self, meshlet: &Meshlet) -> bool {
        Sight::new(&self.screen(), self.cull, &self.mesh.ball).sees(meshlet)
    }

    /// Whether all triangles of a meshlet are left out, and whether all are outside.
    fn hidden(&self, meshlet: &Meshlet) -> [bool; 2] {
        let Screen { to_eye, projection, .. } = self.screen();
        let axes = DMat3::from_cols_array(&to_eye.axes().to_cols_array().map(f64::from));
        let origin = to_eye.origin().coords.as_dvec3();
        let scales = projection.scale_lanes(One, [1.0; 3]).map(f64::from);
        let perspective = projection.is_perspective();
        let [near, far] = [projection.near(), projection.far()].map(f64::from);
        let numbers = meshlet.triangles[0] as usize..meshlet.triangles[1] as usize;
        let (mut away, mut outside) = (true, true);
        for indices in &self.triangles[numbers] {
            let p = indices.map(|index| axes * self.places[index as usize].as_dvec3() + origin);
            let normal = (p[1] - p[0]).cross(p[2] - p[0]);
            let facing = if perspective { normal.dot(p[0]) } else { normal.z };
            let side = |p: DVec3| if perspective { p.z } else { 1.0 };
            let beyond = |plane: &dyn Fn(DVec3) -> f64| p.iter().all(|&p| plane(p) < 0.0);
            outside &= beyond(&|p| p.z - near)
                || beyond(&|p| far - p.z)
                || beyond(&|p| side(p) - p.x * scales[0])
                || beyond(&|p| side(p) + p.x * scales[0])
                || beyond(&|p| side(p) - p.y * scales[1])
                || beyond(&|p| side(p) + p.y * scales[1]);
            away &= match self.cull {
                Cull::Back => facing <= 0.0,
                Cull::Front => facing >= 0.0,
                Cull::None => false,
            };
        }
        [away, outside]
    }

    /// The frame at a part of the way to another place.
    fn moved(&mut self, from: Vec3, to: Vec3, part: f32) {
        self.at = Frame::from_mat3(self.at.axes(), Point3::new(from.lerp(to, part)));
    }
}

/// Places at random, and such as the search finds at the last step before a meshlet is seen.
#[test]
#[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
fn what_is_left_out_faces_away_or_is_outside() {
    let mut rng = Rng::stream(run_seed(), 83);
    let (mut hidden, mut left_out, mut searched) = ([0u32; 2], [0u32; 2], [0u32; 2]);
    for round in 0..300 {
        let (places, triangles) = bumps(&mut rng);
        let split = Split::new(&places, &triangles, [2, 6, 16, 60][round % 4]);
        let stage: fn(&Vec3) -> (Vec3, ()) = |&place| (place, ());
        let mesh = Mesh::new(&places, &split.triangles, stage);
        let (meshlets, ball) = split.bounds(&mesh);
        assert_eq!(meshlets.last().map(|last| last.triangles[1] as usize), Some(split.triangles.len()));
        let mesh = Meshlets { mesh, meshlets: &meshlets, ball };
        let (view, at) = view(&mut rng, &ball);
        let cull = [Cull::Back, Cull::Front, Cull::None][rng.index(8).min(2)];
        let mut scene = Scene { places: &places, triangles: &split.triangles, mesh: &mesh, view, at, cull };
        let sight = Sight::new(&scene.screen(), cull, &ball);
        for meshlet in &meshlets {
            let facts = scene.hidden(meshlet);
            hidden[usize::from(!facts[0])] += u32::from(facts[0] | facts[1]);
            if !sight.sees(meshlet) {
                assert!(facts[0] | facts[1], "{meshlet:?} of round {round} by {sight:?}");
                left_out[usize::from(!facts[0])] += 1;
            }
        }
        for _ in 0..40 {
            let meshlet = &meshlets[rng.index(meshlets.len())];
            let from = at.origin().coords;
            let to = from + Vec3::from_array([(); 3].map(|()| rng.uniform(-1.0, 1.0) as f32)) * from.length();
            scene.moved(from, to, 1.0);
            let ends = [sight.sees(meshlet), scene.sees(meshlet)];
            if ends[0] == ends[1] {
                continue;
            }
            let (from, to) = if ends[0] { (to, from) } else { (from, to) };
            let (mut unseen, mut seen) = (0.0, 1.0);
            for _ in 0..25 {
                let part = (unseen + seen) / 2.0;
                scene.moved(from, to, part);
                *(if scene.sees(meshlet) { &mut seen } else { &mut unseen }) = part;
            }
            scene.moved(from, to, unseen);
            let facts = scene.hidden(meshlet);
            assert!(facts[0] | facts[1], "{meshlet:?} of round {round} where it is seen next");
            searched[usize::from(!facts[0])] += 1;
            scene.at = at;
        }
    }
    println!("facing away and outside: {left_out:?} of {hidden:?} left out, {searched:?} just so");
    assert!(left_out[0] > hidden[0] / 3 && left_out[1] > hidden[1] / 2, "{left_out:?} of {hidden:?}");
    assert!(searched.into_iter().all(|count| count > 30), "{searched:?}");
}

const SIDE: u32 = 96;
const PIXELS: usize = (SIDE * SIDE) as usize;

/// All ways of drawing make the same picture, which is that of the mesh without meshlets but for triangles that
/// snapping turns.
#[test]
fn pictures_are_those_without_meshlets() {
    let mut rng = Rng::stream(run_seed(), 84);
    let (mut drawn, mut different) = (0, 0);
    for round in 0..60 {
        let (places, triangles) = bumps(&mut rng);
        let split = Split::new(&places, &triangles, 16);
        let stage = |&place: &Vec3| (place, place);
        let plain = Mesh::new(&places, &split.triangles, stage);
        let (meshlets, ball) = split.bounds(&plain);
        let mesh = Meshlets { mesh: plain, meshlets: &meshlets, ball };
        let (view, at) = view(&mut rng, &ball);
        let color =
            |v: Vec3| Some(v.x.to_bits() ^ v.y.to_bits().rotate_left(11) ^ v.z.to_bits().rotate_left(22));
        let cull = [Cull::Back, Cull::Front][round % 2];
        let mut slots = std::vec![Slot::EMPTY; [places.len(), 7][round % 2]];
        let picture = |draw: &mut dyn FnMut(&mut Target<'_, Rgba8888, F32>)| {
            let (mut color, mut depth) = (std::vec![0; PIXELS], std::vec![1.0; PIXELS]);
            draw(&mut Target::new(Rgba8888, F32, SIDE, SIDE, &mut color, &mut depth).expect("a frame"));
            color
        };
        let right = picture(&mut |target| Pass::new(&view, &plain, color).at(at).cull(cull).draw(target));
        let mut pass = Pass::new(&view, &mesh, color).at(at).cull(cull).slots(&mut slots);
        let one = picture(&mut |target| pass.draw_by(One, target));
        drawn += right.iter().filter(|&&color| color != 0).count();
        different += right.iter().zip(&one).filter(|(a, b)| a != b).count();
        assert!(one == picture(&mut |target| pass.draw(target)), "by lanes in round {round}");
        let mut room = std::vec![PreparedTriangle::EMPTY; [split.triangles.len(), 20][round % 2]];
        #[cfg(feature = "threads")]
        {
            let threads = core::num::NonZero::new(3).expect("three");
            let by_threads = picture(&mut |target| pass.draw_by_threads(threads, &mut room, target));
            assert!(one == by_threads, "by threads in round {round}");
        }
        let mut prepared = pass.count_prepare([SIDE; 2], F32, &mut room, &mut ()).0;
        let in_bands =
            picture(&mut |target| target.split(13).for_each(|mut band| prepared.draw_by(One, &mut band)));
        assert!(one == in_bands, "in bands in round {round}");
    }
    println!("{different} of {drawn} pixels are others");
    assert!(drawn > 10_000 && different <= drawn / 500);
}
