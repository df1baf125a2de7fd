//! A ground under a model, of which only its soft shadow is seen: the background shows through all else, or a floor of
//! the model's own, on which it lies.
//!
//! The shadow is that of a sky without a sun: a texture of alpha, made once, of how much of the sky the model hides.

use super::{Camera, Image, Map, Model, Part, Vertex, order};
use crate::options::{DepthFormat, Filter, Wrap};
use crate::scene::camera::Sight;
use crate::scene::normals::{dot, narrow, sub};
use crate::scene::swept::Reached;
use alberti::raster::color::AnyBlend;
use sky::Sky;
use std::sync::Arc;

mod floor;
mod framed;
mod opacity;
mod planes;
mod sky;

pub(crate) use floor::bounds;
pub(crate) use framed::in_view;
pub(crate) use planes::Stood;

/// Cells along a side of the ground, at least and at most: powers of two.
const CELLS: [u32; 2] = [256, 1024];

/// Cells that a shadow reaches, if there may be so many.
const FINENESS: f64 = 60.0;

/// The alpha of a place that sees no sky.
const DARKEST: f64 = 0.8;

/// The share of a ball's radius that the ground and the shadow reach beyond what stands on it.
const RIM: f64 = 0.9;

/// The multiple of its height beyond which a thing hides next to nothing: so far they reach at most.
const SLANT: f64 = 2.5;

/// A ground before the eyes of a camera.
#[derive(Clone, Copy, Debug)]
struct Ground {
    /// The upward axis and its sign.
    up: (usize, f64),
    /// The corner with the least coordinates, in the other two axes, and the side.
    corner: [f64; 2],
    side: f64,
    /// The height along the upward axis.
    low: f64,
    /// The distance up to which a face is at that height.
    near: f64,
    /// Whether it is just over a floor of the model's own, and has the shadow there.
    on_floor: bool,
    /// Whether it is all around, and not on the floor alone.
    goes_on: bool,
    /// Whether nothing on it throws a shadow.
    is_flat: bool,
    /// How high the model is above it.
    height: f64,
    /// How far away the model still darkens it.
    reach: f64,
    /// Cells along a side, a power of two. Texels of the shadow have two by two.
    cells: u32,
}

/// The way in which a ground is drawn.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Manner<'a> {
    /// Whether the user has set the near and the far plane.
    pub(crate) fixed: [bool; 2],
    /// A picture in perspective; none of one in parallel projection.
    pub(crate) sight: Option<Sight>,
    /// Whether attributes are affine.
    pub(crate) affine: bool,
    pub(crate) depth: DepthFormat,
    /// The continuation of textures that say none.
    pub(crate) wrap: Wrap,
    pub(crate) shadows: Shadows<'a>,
}

/// The images of shadows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) enum Shadows<'a> {
    #[default]
    Made,
    /// Made of half as many cells along each side: for what moves, at once.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "nothing is in haste but a window"))]
    Coarse,
    /// Those of the same model, if they have as many cells.
    Kept(&'a [Arc<Image>]),
}

/// Adds a ground at the lowest point of a model, or of all places that it comes to, along the upward direction. A floor
/// of its own has the shadow on it, which goes on beyond. There is none if all of the cameras are below it. Planes of
/// the others that are not fixed are moved so that all that is in the picture is between them. Where attributes are
/// affine, it is of so many parts that none shows that.
pub(crate) fn add(
    model: &mut Model,
    (swept, up): (Option<&Reached>, [f32; 3]),
    cameras: &mut [Camera],
    manner: Manner<'_>,
) -> Option<Stood> {
    let Manner { fixed, sight, affine, depth, wrap, shadows } = manner;
    let mut grounds = floor::grounds(model, swept, up, depth);
    let kept = match shadows {
        Shadows::Made => &[],
        Shadows::Coarse => {
            grounds.iter_mut().for_each(|ground| ground.cells /= 2);
            &[]
        }
        Shadows::Kept(kept) => kept,
    };
    let lowest = grounds.last()?;
    let corners =
        |ground: &Ground| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|uv| ground.place(uv));
    let around = grounds.iter().filter(|ground| ground.goes_on).map(corners).collect();
    let mut stood = Stood { lowest: *lowest, shadows: Vec::new(), around, sight, fixed };
    if !cameras.iter().any(|camera| stood.is_below(camera)) {
        return None;
    }
    cameras.iter_mut().for_each(|camera| stood.stretch(camera));
    // Few, where attributes are right anywhere.
    let squares = if affine { 48 } else { 1 };
    // All of them before one is a part of the model.
    let all: Vec<_> = grounds
        .iter()
        .enumerate()
        .map(|(number, ground)| {
            let side = ground.cells / 2;
            let is_its_own = |image: &&Arc<Image>| kept.len() == grounds.len() && image.width == side;
            let shadow = kept.get(number).filter(is_its_own).cloned().unwrap_or_else(|| {
                let texels = ground.shadow(model, wrap).into_iter().map(|alpha| [0, 0, 0, alpha]).collect();
                Image { width: side, height: side, texels }.into()
            });
            let floor = ground.on_floor.then(|| {
                let places = floor::places(model, ground, squares);
                let count = u32::try_from(places.len()).unwrap_or(0);
                (
                    places,
                    (0..count).step_by(3).map(|k| [k, k + 1, k + 2]).collect(),
                    floor::after(model, ground),
                )
            });
            (ground, shadow, floor)
        })
        .collect();
    // The last to be drawn comes first, since each is put before what there is.
    for (ground, shadow, floor) in all {
        stood.shadows.push(Arc::clone(&shadow));
        model.textures.push(shadow);
        if let Some((places, triangles, after)) = floor {
            ground.put(model, (places, triangles), (depth == DepthFormat::None).then_some(after));
        }
        if ground.goes_on {
            ground.put(model, ground.squares(squares), (depth == DepthFormat::None).then_some(0));
        }
    }
    Some(stood)
}

/// The share of a model's radius up to which it is flat: there is no shadow beside it.
const FLAT: f64 = 1e-3;

/// The shares of a model's radius that its ground is below it, or over its floor: as many as depths can tell.
fn below(depth: DepthFormat) -> f64 {
    if depth == DepthFormat::U16 { 2e-3 } else { 1e-4 }
}

/// Whether cameras are above the ground of a model, or of all places that it comes to, which is across the upward
/// direction. None if there is nothing to stand on it.
pub(crate) fn above(
    model: &Model,
    (swept, up): (Option<&Reached>, [f32; 3]),
    cameras: &[Camera],
    depth: DepthFormat,
) -> Option<Vec<bool>> {
    let grounds = floor::grounds(model, swept, up, depth);
    let ground = grounds.last()?;
    Some(cameras.iter().map(|camera| ground.is_below(camera)).collect())
}

/// Whether a model has a floor of its own, and its shadow there alone.
pub(crate) fn has_floor(model: &Model, swept: Option<&Reached>, up: [f32; 3]) -> bool {
    floor::grounds(model, swept, up, DepthFormat::default()).last().is_some_and(|ground| ground.on_floor)
}

/// Places, and triangles of these.
type Surface = (Vec<[f64; 3]>, Vec<[u32; 3]>);

impl Ground {
    /// Whether a camera sees it from above.
    fn is_below(&self, camera: &Camera) -> bool {
        let (up, sign) = self.up;
        sign * (f64::from(camera.eye[up]) - self.low) > 0.0
    }

    /// The ground that many radii below a model.
    fn of(model: &Model, upwards: [f32; 3], below: f64) -> Option<Self> {
        let up = (0..3).max_by(|&a, &b| upwards[a].abs().total_cmp(&upwards[b].abs()))?;
        Self::under(floor::bounds(places(model)), (up, f64::from(upwards[up].signum())), below)
    }

    /// That of things between these least and greatest coordinates, along an axis and its sign.
    fn under([least, most]: [[f64; 3]; 2], (up, sign): (usize, f64), below: f64) -> Option<Self> {
        let size = sub(most, least);
        let radius = dot(size, size).sqrt() / 2.0;
        if !(radius > 0.0 && radius.is_finite()) {
            return None;
        }
        // Just below, so that what stands on it hides it.
        let low = if sign > 0.0 { least[up] } else { most[up] } - sign * below * radius;
        let axes = others(up);
        let reach = (RIM * radius).min(SLANT * size[up]).max(1e-3 * radius);
        let side = size[axes[0]].max(size[axes[1]]) + 2.0 * reach;
        let corner = axes.map(|axis| f64::midpoint(least[axis], most[axis]) - side / 2.0);
        let [least, most] = CELLS;
        let is_fine = |cells: &u32| f64::from(*cells) * reach >= FINENESS * side;
        let cells =
            std::iter::successors(Some(least), |cells| Some(2 * cells)).find(|c| is_fine(c) || *c >= most);
        let height = size[up] + below * radius;
        let near = 4.0 * below.abs() * radius;
        let cells = cells.unwrap_or(most);
        let is_flat = size[up] <= FLAT * radius;
        let up = (up, sign);
        let (on_floor, goes_on) = (false, true);
        Some(Self { up, corner, side, low, near, on_floor, goes_on, is_flat, height, reach, cells })
    }

    /// Puts a part with its shadow into a model, whose last texture that is: at this place among the parts, or behind
    /// all that depth orders.
    fn put(&self, model: &mut Model, (places, triangles): Surface, at: Option<usize>) {
        let first = u32::try_from(model.vertices.len()).unwrap_or(u32::MAX);
        let mut normal = [0.0; 3];
        normal[self.up.0] = narrow(self.up.1);
        model.vertices.extend(places.into_iter().map(|place| Vertex {
            position: place.map(narrow),
            normal,
            uv: self.shares(place).map(narrow),
            ..Vertex::default()
        }));
        let triangles = triangles.into_iter().map(|triangle| triangle.map(|k| first + k)).collect();
        let map =
            Map { image: model.textures.len() - 1, filter: Some(Filter::Bilinear), wrap: Some(Wrap::Clamp) };
        let mut part =
            Part { name: "ground".to_owned(), triangles, texture: Some(map.image), ..Part::default() };
        (part.detail.filter, part.detail.wrap) = (map.filter, map.wrap);
        (part.detail.blend, part.detail.specular) = (AnyBlend::Over, [0.0; 3]);
        match at {
            Some(at) => model.parts.insert(at, part),
            None => order::behind_all(model, part),
        }
    }

    /// A place on it, of shares of its sides. Around a floor it is as far below that as it is above on it.
    fn place(&self, shares: [f64; 2]) -> [f64; 3] {
        let beside = if self.on_floor { self.near / 2.0 } else { 0.0 };
        let mut place = [self.low - self.up.1 * beside; 3];
        for ((axis, corner), share) in others(self.up.0).into_iter().zip(self.corner).zip(shares) {
            place[axis] = corner + share * self.side;
        }
        place
    }

    /// The shares of its sides at which a place is.
    fn shares(&self, place: [f64; 3]) -> [f64; 2] {
        let [a, b] = others(self.up.0);
        [(place[a] - self.corner[0]) / self.side, (place[b] - self.corner[1]) / self.side]
    }

    /// So many squares along each side: their corners, and triangles of these.
    fn squares(&self, count: u16) -> Surface {
        let shares = || (0..=count).map(|k| f64::from(k) / f64::from(count));
        let places = shares().flat_map(|v| shares().map(move |u| self.place([u, v]))).collect();
        let count = u32::from(count);
        let square = |(row, column): (u32, u32)| {
            let corner = |up: u32, right: u32| (row + up) * (count + 1) + column + right;
            let [a, b, c, d] = [corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)];
            [[a, b, c], [a, c, d]]
        };
        let squares = (0..count).flat_map(|row| (0..count).map(move |column| (row, column)));
        (places, squares.flat_map(square).collect())
    }

    /// A place in cells: columns, rows, and how high.
    fn cells(&self, place: [f64; 3]) -> [f64; 3] {
        let scale = f64::from(self.cells) / self.side;
        let [a, b] = others(self.up.0);
        let height = self.up.1 * (place[self.up.0] - self.low);
        [(place[a] - self.corner[0]) * scale, (place[b] - self.corner[1]) * scale, height * scale]
    }

    /// The alpha of each texel, rows from the one with the greatest coordinate.
    fn shadow(&self, model: &Model, wrap: Wrap) -> Vec<u8> {
        let scale = f64::from(self.cells) / self.side;
        let sky = Sky::over(self, model, wrap, self.height * scale);
        let mut dark = sky.darkness(self.reach * scale);
        let side = self.cells as usize / 2;
        // Neighbours look in different directions.
        blur(&mut dark, side);
        let alpha = |&dark: &f64| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
            let alpha = (dark * DARKEST * 255.0).round() as u8;
            alpha
        };
        dark.chunks(side).rev().flatten().map(alpha).collect()
    }
}

/// Twice each texel and its neighbours, over four: along rows, then along columns. Beyond the sides there is nothing.
fn blur(texels: &mut [f64], side: usize) {
    for (stride, step) in [(1, side), (side, 1)] {
        for start in (0..side).map(|k| k * step) {
            let mut before = 0.0;
            for k in 0..side {
                let at = start + k * stride;
                let (own, after) = (texels[at], if k + 1 < side { texels[at + stride] } else { 0.0 });
                texels[at] = (before + 2.0 * own + after) / 4.0;
                before = own;
            }
        }
    }
}

/// The axes of the ground, so that they and the upward one are right-handed.
fn others(up: usize) -> [usize; 2] {
    [(up + 1) % 3, (up + 2) % 3]
}

/// The places of all vertices that are drawn.
fn places(model: &Model) -> impl Iterator<Item = [f64; 3]> {
    let used = model.parts.iter().flat_map(|part| part.triangles.iter().flatten());
    used.filter_map(|&k| model.vertices.get(k as usize)).map(|v| v.position.map(f64::from))
}

#[cfg(test)]
mod tests;
