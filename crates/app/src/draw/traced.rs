//! The fragments that arrive at one pixel, as they are drawn: triangle by triangle, by the policies of the options, on
//! one lane. Their numbers are those of the picture, since no bit of it depends on lanes, bands or slots.

mod depth;
mod look;
mod reads;

use super::clothed::Clothed;
use super::erased::Attributes;
use super::facing::turn;
use super::general::{Shown, Surface};
use super::{Drawing, position};
use crate::error::Error;
use crate::options::{Arithmetic, Interpolation};
use crate::render::any_depth;
use crate::scene::{Part, Vertex};
use alberti::glam::Vec3;
use alberti::lanes::{Lanes, One, OneFixed};
use alberti::raster::{AnyDerivatives, Corner, Numbers};
use alberti::{
    AnyProjection, Cull, DepthFormat as _, Fixed, FixedPoint, FragmentStage, Fragments, Geometry, Gradient,
    Mesh, Object, Pass, Planes, Point3, Q16, Rgba8, Rgba8888, Slot, Stats, Target, Varying,
};
use depth::{Trace, TracedDepth};
pub(crate) use look::{Light, LightRead, Look};
pub(crate) use reads::{MapRead, ProbeRead};
use std::cell::RefCell;

/// The numbers of a fragment, or of a corner: the place on a projector's image, and the surface's.
pub(crate) type Bundle<T> = <Attributes as Varying>::Of<T>;

/// The numbers of a corner.
pub(crate) type Corner3 = alberti::raster::Vertex<Attributes>;

/// The components of a bundle, side by side.
pub(crate) const COMPONENTS: usize = 17;

/// The components of a bundle.
pub(crate) fn components<T: Copy>((image, framed): &Bundle<T>) -> [T; COMPONENTS] {
    let [[a, b, c], [d, e, f], [g, h, i]] = framed.axes;
    let ([u, v], [x, y, z], [s, t, q]) = (framed.uv, framed.position, *image);
    [s, t, q, x, y, z, a, b, c, d, e, f, g, h, i, u, v]
}

// The first components of a place on an image, of a position, of the three axes, and of coordinates.
const IMAGE: usize = 0;
const POSITION: usize = 3;
const FIRST: usize = 6;
const SECOND: usize = 9;
const THIRD: usize = 12;
pub(crate) const UV: usize = 15;

/// A fragment that has come to the pixel.
#[derive(Clone, Copy)]
pub(crate) struct Arrival {
    /// The index of its part.
    pub(crate) part: usize,
    /// The number of its triangle in the part.
    pub(crate) triangle: usize,
    /// The depth that was interpolated: the bits of an `f32`, or in fixed point a word whose highest bits count.
    pub(crate) zs: u32,
    /// The word of the depth format.
    pub(crate) depth: u32,
    /// The word that the buffer held before.
    pub(crate) before: u32,
    /// Whether it passed the depth test.
    pub(crate) seen: bool,
    /// The attributes: bits of `f32`, or units of 2^-16 in fixed point.
    pub(crate) varying: Bundle<u32>,
    /// Their derivatives in the same numbers.
    pub(crate) gradient: Gradient<Bundle<u32>>,
}

/// All that has come to a pixel.
#[derive(Clone, Default)]
pub(crate) struct Traced {
    /// In drawing order.
    pub(crate) arrivals: Vec<Arrival>,
    /// The fates of all triangles; of fragments, those at the pixel.
    pub(crate) stats: Stats,
}

/// A triangle on the screen, in the order in which it was given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// The weights of the whole triangle's vertices at each corner.
    pub(crate) weights: [Vec3; 3],
    /// The corners as they come from the view.
    pub(crate) given: [Corner3; 3],
    /// The same, with the values at their subpixels.
    pub(crate) drawn: [Corner3; 3],
}

/// A part's surface, all that its attributes are made of, and the stage that colours it.
pub(super) struct Dressed<'a> {
    clothed: Clothed<'a>,
    shown: Shown<'a>,
}

impl Dressed<'_> {
    fn attributes(&self, v: &Vertex) -> Attributes {
        (self.clothed.on_image(v), self.clothed.vertex(v).1)
    }
}

impl<'a> Drawing<'a> {
    /// The fragments that come to a pixel; `cull` says the faces that are left out.
    ///
    /// # Errors
    /// A size that cannot be drawn.
    pub(crate) fn trace(&self, [column, row]: [u32; 2], cull: Cull) -> Result<Traced, Error> {
        let mut traced = Traced::default();
        let format = TracedDepth(any_depth(self.options.depth));
        let width = self.options.width as usize;
        let (mut color, mut depth) = (vec![0; width], vec![Trace::cleared(format.0); width]);
        let (derivatives, records) = (self.derivatives(), RefCell::new(Vec::new()));
        for (number, part) in self.model.parts.iter().enumerate() {
            let dressed = self.dressed(part);
            for (triangle, indices) in part.triangles.iter().enumerate() {
                let Some(vertices) = self.vertices(*indices) else { continue };
                let target = Target::band(Rgba8888, format, self.size(), row, &mut color, &mut depth);
                let mut target =
                    target.map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
                let pixel = [column, row].map(u32::cast_signed).map(|at| at..at + 1);
                let [columns, rows] = pixel;
                let mut pixel = target.scissor(columns, rows);
                let mesh =
                    Mesh::new(&vertices, &ONE_TRIANGLE, |v: &Vertex| (position(v), dressed.attributes(v)));
                self.draw_traced(
                    &mesh,
                    Recorder { derivatives, records: &records },
                    cull,
                    &mut pixel,
                    &mut traced.stats,
                );
                let records = records.borrow_mut().drain(..).collect::<Vec<Record>>();
                if records.is_empty() {
                    continue;
                }
                let Some(trace) = depth.get_mut(column as usize) else { continue };
                for (Record { varying, gradient }, test) in records.into_iter().zip(trace.take()) {
                    let depth::Test { zs, word: depth, before, seen } = test;
                    traced.arrivals.push(Arrival {
                        part: number,
                        triangle,
                        zs,
                        depth,
                        before,
                        seen,
                        varying,
                        gradient,
                    });
                }
            }
        }
        Ok(traced)
    }

    /// The triangles on the screen that one of a part's is drawn as.
    pub(crate) fn pieces(&self, part: &Part, triangle: usize) -> Vec<Piece> {
        let indices = part.triangles.get(triangle);
        let Some(vertices) = indices.and_then(|indices| self.vertices(*indices)) else { return Vec::new() };
        let dressed = self.dressed(part);
        let mesh = Mesh::new(&vertices, &ONE_TRIANGLE, |v: &Vertex| (position(v), dressed.attributes(v)));
        let carried = match (self.lines(), self.options.policies.arithmetic) {
            (Some(lines), Arithmetic::Fixed) => {
                let depth_bits = any_depth(self.options.depth).bits();
                let pass = self.pass(&mesh, (), &mut []).interpolation(FixedPoint(lines));
                self.on_screen(&pass, Numbers::Fixed { depth_bits })
            }
            _ => self.on_screen(&self.pass(&mesh, (), &mut []), Numbers::Float),
        };
        let own = [Vec3::X, Vec3::Y, Vec3::Z];
        let corners = [0, 1, 2].map(|k| (position(&vertices[k]), own[k]));
        let mesh = Mesh::new(&corners, &ONE_TRIANGLE, |corner: &(Point3<Object>, Vec3)| *corner);
        let weights = self.on_screen(&self.pass(&mesh, (), &mut []), Numbers::Float);
        let pairs = carried.into_iter().zip(weights);
        let piece = |((given, drawn), (weights, _)): (Pair<Attributes>, Pair<Vec3>)| Piece {
            weights: weights.map(|vertex| vertex.varying),
            given,
            drawn,
        };
        pairs.map(piece).collect()
    }

    /// The triangles on the screen that the only one of a pass becomes: as they come from the view, and with the values
    /// at their subpixels.
    fn on_screen<M: Geometry, P: alberti::Interpolation>(
        &self,
        pass: &Pass<'_, M, (), P, AnyProjection>,
        numbers: Numbers,
    ) -> Vec<Pair<M::Varying>> {
        let mut found = Vec::new();
        pass.on_screen(self.size(), any_depth(self.options.depth), 0, |corners| {
            let given = corners.map(|corner| corner.vertex(numbers));
            let in_order = Corner::as_drawn(corners, numbers, self.subpixel());
            let in_order = in_order.map(|corners| corners.map(|corner| corner.vertex(numbers)));
            // A corner keeps its place, whatever the order.
            let drawn = given.map(|own| {
                let same = |other: &&alberti::raster::Vertex<_>| (other.x, other.y) == (own.x, own.y);
                in_order.as_ref().and_then(|all| all.iter().find(same)).copied().unwrap_or(own)
            });
            found.push((given, drawn));
        });
        found
    }

    /// Hands on the places of the triangles on the screen that one with these vertices is drawn as.
    pub(crate) fn each_place(&self, indices: [u32; 3], mut hear: impl FnMut([[Fixed; 2]; 3])) {
        let Some(vertices) = self.vertices(indices) else { return };
        let mesh = Mesh::new(&vertices, &ONE_TRIANGLE, |v: &Vertex| (position(v), ()));
        for (corners, _) in self.on_screen(&self.pass(&mesh, (), &mut []), Numbers::Float) {
            hear(corners.map(|corner| [corner.x, corner.y]));
        }
    }

    /// The way of a fragment's numbers to a colour on its part.
    pub(crate) fn look(&self, arrival: &Arrival, place: [u32; 2]) -> Option<Look> {
        let part = self.model.parts.get(arrival.part)?;
        let (mut dressed, place) = (self.dressed(part), place.map(u32::cast_signed));
        if let Some(triangle) = part.triangles.get(arrival.triangle) {
            dressed.shown = dressed.shown.on(part, triangle);
        }
        let Arrival { varying, gradient, .. } = arrival;
        Some(if self.options.policies.arithmetic == Arithmetic::Fixed {
            let number = |word: u32| Q16::from_bits(word.cast_signed());
            let all = |bundle: Bundle<u32>| Attributes::map(&bundle, &number);
            let (varying, gradient) = (all(*varying), gradient.map(all));
            self.look_by(
                OneFixed,
                part,
                &dressed,
                &Fragments { lanes: OneFixed, varying, gradient, mask: true, place },
            )
        } else {
            let all = |bundle: Bundle<u32>| Attributes::map(&bundle, &f32::from_bits);
            let (varying, gradient) = (all(*varying), gradient.map(all));
            self.look_by(One, part, &dressed, &Fragments { lanes: One, varying, gradient, mask: true, place })
        })
    }

    /// The components that a part's surface uses, with their names.
    pub(crate) fn used(&self, part: &Part) -> Vec<(&'static str, usize)> {
        let dressed = self.dressed(part);
        let mut used = Vec::new();
        let mut put = |names: &[&'static str], first: usize| used.extend(names.iter().copied().zip(first..));
        if dressed.clothed.textured {
            put(&["u", "v"], UV);
        }
        match dressed.shown.surface {
            Surface::Colors => put(&["red", "green", "blue"], THIRD),
            Surface::Unlit(_) => {}
            Surface::Lit(_) => put(&NORMAL, THIRD),
            Surface::ByFragment(_) => {
                put(&NORMAL, THIRD);
                if part.detail.carries_colors() {
                    put(&["red", "green", "blue"], FIRST);
                }
                if part.detail.needs_tangents() {
                    put(&["tangent x", "tangent y", "tangent z"], FIRST);
                    put(&["bitangent x", "bitangent y", "bitangent z"], SECOND);
                }
                put(&["position x", "position y", "position z"], POSITION);
            }
            Surface::ByVertex(_) => {
                put(&["scattered red", "scattered green", "scattered blue"], FIRST);
                put(&["mirrored red", "mirrored green", "mirrored blue"], SECOND);
            }
        }
        if dressed.clothed.projector.is_some() {
            put(&["image u", "image v", "image q"], IMAGE);
        }
        used
    }

    /// The sides of the texture on a part, where it is shown.
    pub(crate) fn texture_size(&self, part: &Part) -> Option<[u32; 2]> {
        let texture = self.textures.get(part.texture?)?;
        self.dressed(part).clothed.textured.then(|| [texture.width(), texture.height()])
    }

    /// Draws a triangle by the options' policies.
    fn draw_traced<M: Geometry<Varying = Attributes>>(
        &self,
        mesh: &M,
        stage: Recorder<'_>,
        cull: Cull,
        target: &mut Target<'_, Rgba8888, TracedDepth>,
        stats: &mut Stats,
    ) {
        let mut slots = [Slot::EMPTY; 3];
        let mut pass = self.pass(mesh, stage, &mut slots).cull(cull);
        match (self.lines(), self.options.policies) {
            (Some(lines), policies) if policies.arithmetic == Arithmetic::Fixed => {
                pass.interpolation(FixedPoint(lines)).count_by(One, target, stats);
            }
            (Some(lines), _) => pass.interpolation(lines).count_by(One, target, stats),
            (None, policies) if policies.interpolation == Interpolation::Plane => {
                pass.interpolation(Planes).count_by(One, target, stats);
            }
            (None, _) => pass.count_by(One, target, stats),
        }
    }

    /// A part's surface.
    fn dressed(&self, part: &Part) -> Dressed<'a> {
        let clothed = self.clothed(part);
        Dressed { shown: self.shown(clothed.surface, part), clothed }
    }

    fn vertices(&self, indices: [u32; 3]) -> Option<[Vertex; 3]> {
        let [a, b, c] = indices.map(|index| self.model.vertices.get(index as usize).copied());
        let vertices = [a?, b?, c?];
        let behind = self.viewpoint.is_some_and(|viewpoint| viewpoint.is_behind(vertices.each_ref()));
        Some(if behind { vertices.each_ref().map(turn) } else { vertices })
    }

    fn size(&self) -> [u32; 2] {
        [self.options.width, self.options.height]
    }
}

/// A triangle on the screen as it comes from the view, and with the values at its subpixels.
type Pair<V> = ([alberti::raster::Vertex<V>; 3], [alberti::raster::Vertex<V>; 3]);

const ONE_TRIANGLE: [[u32; 3]; 1] = [[0, 1, 2]];

const NORMAL: [&str; 3] = ["normal x", "normal y", "normal z"];

/// The numbers that a fragment stage gets.
#[derive(Clone, Copy)]
struct Record {
    varying: Bundle<u32>,
    gradient: Gradient<Bundle<u32>>,
}

/// A stage that writes them down.
#[derive(Clone, Copy)]
struct Recorder<'a> {
    derivatives: AnyDerivatives,
    records: &'a RefCell<Vec<Record>>,
}

impl FragmentStage<Attributes> for Recorder<'_> {
    type Color = Rgba8;
    type Derivatives = AnyDerivatives;

    fn derivatives(&self) -> AnyDerivatives {
        self.derivatives
    }

    /// One lane is all that is drawn with.
    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Attributes>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying, gradient, mask, .. } = fragments;
        let first = |words: &[u32]| words.first().copied().unwrap_or_default();
        let bits = |number: L::Number| {
            if L::FIXED {
                return first(lanes.store_words(lanes.floor_scaled(number, 16)).as_ref());
            }
            lanes.store(number).as_ref().first().map_or(0, |float: &f32| float.to_bits())
        };
        let all = |bundle: Bundle<L::Number>| Attributes::map(&bundle, &bits);
        self.records.borrow_mut().push(Record { varying: all(*varying), gradient: gradient.map(all) });
        (lanes.word(0), *mask)
    }
}
