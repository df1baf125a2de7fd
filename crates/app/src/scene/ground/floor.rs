//! A floor of the model's own, on which a shadow lies instead of on a ground.

use super::{Ground, Model, below, others};
use crate::options::DepthFormat;
use crate::scene::camera::within;
use crate::scene::swept::Reached;
use crate::scene::{Part, Vertex};
use alberti::texture::surface::Subdivision;

/// The share of a model's height that things may reach below its floor.
const DIP: f64 = 0.25;

/// The share of a model's extent that a floor has at least, and that of a slab's upper side which all below it has.
const LARGE: f64 = 0.25;
const LITTLE: f64 = 0.5;

/// The share of a model's side within which faces are at the same height, whatever the sizes of things.
const EXACT: f64 = 1e-6;

/// The grounds of a model, or of all places that it comes to, the upper one first. It is just over a floor of the
/// model's own, if it has one, and just below the lowest point otherwise. Where the floor is a slab's upper side, or
/// things beside it reach below it, there are both. None if there is nothing to stand on it.
pub(super) fn grounds(
    model: &Model,
    swept: Option<&Reached>,
    upwards: [f32; 3],
    depth: DepthFormat,
) -> Vec<Ground> {
    let whole = swept.map_or(model, |swept| &swept.whole);
    let Some(ground) = Ground::of(whole, upwards, below(depth)) else { return Vec::new() };
    let [a, b] = others(ground.up.0);
    let [least, most] = bounds(super::places(whole));
    let extent = (most[a] - least[a]) * (most[b] - least[b]);
    let alone = if ground.is_flat { Vec::new() } else { vec![ground] };
    let Some(Floor { height, sides: [low, high], is_slab }) = found(model, &ground, extent) else {
        return alone;
    };
    let Some(on_floor) = of_things((model, swept), &ground, height, depth) else {
        return if is_slab { alone } else { Vec::new() };
    };
    let is_deep = |place: &[f64; 3]| ground.up.1 * (place[ground.up.0] - ground.low) < height - ground.near;
    let is_beside = |place: &[f64; 3]| {
        let beside =
            |k: usize, axis: usize| place[axis] < low[k] - ground.near || place[axis] > high[k] + ground.near;
        beside(0, a) || beside(1, b)
    };
    if is_slab || super::places(whole).any(|place| is_deep(&place) && is_beside(&place)) {
        return vec![Ground { goes_on: false, ..on_floor }, ground];
    }
    vec![on_floor]
}

/// The ground of a floor at a height over another, for the things that come to stand there: as large as their shadow,
/// however far the floor goes on. It is as far over the floor as the other is below the lowest point, in their own
/// sizes.
fn of_things(
    (model, swept): (&Model, Option<&Reached>),
    ground: &Ground,
    height: f64,
    depth: DepthFormat,
) -> Option<Ground> {
    let (up, sign) = ground.up;
    let level = ground.low + sign * height;
    let exact = EXACT * ground.side;
    let is_over = |v: &&Vertex| sign * (f64::from(v.position[up]) - level) > exact;
    let triangles = model.parts.iter().flat_map(|part| &part.triangles);
    let things =
        triangles.filter_map(|triangle| corners(model, triangle)).filter(|all| all.iter().any(is_over));
    let moving = swept.into_iter().flat_map(|swept| &swept.moving);
    let moving = moving.filter(|bounds| bounds.iter().any(|place| sign * (place[up] - level) > exact));
    let places = things.flatten().map(|v| v.position.map(f64::from)).chain(moving.flatten().copied());
    let mut bounds = bounds(places);
    bounds[usize::from(sign < 0.0)][up] = level;
    let things = Ground::under(bounds, ground.up, -below(depth)).filter(|things| !things.is_flat)?;
    Some(Ground { near: things.near.max(exact), on_floor: true, ..things })
}

/// The lowest level of faces that look up and have much of a model's extent.
struct Floor {
    /// How high it is over the ground.
    height: f64,
    /// The least and the greatest coordinates along the other axes.
    sides: [[f64; 2]; 2],
    /// Whether there is more below it than the feet of things.
    is_slab: bool,
}

fn found(model: &Model, ground: &Ground, extent: f64) -> Option<Floor> {
    let (up, sign) = ground.up;
    let [a, b] = others(up);
    let over = |v: &Vertex| sign * (f64::from(v.position[up]) - ground.low);
    let plan = |[p, q, r]: [&Vertex; 3]| {
        let [p, q, r] = [p, q, r].map(|v| [a, b].map(|k| f64::from(v.position[k])));
        ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])).abs() / 2.0
    };
    let triangles = || {
        let all = model.parts.iter().flat_map(|part| &part.triangles);
        all.filter_map(|triangle| corners(model, triangle))
    };
    let range = |corners: [&Vertex; 3]| {
        let [x, y, z] = corners.map(over);
        [x.min(y).min(z), x.max(y).max(z)]
    };
    // The ground is so far below the lowest point.
    let offset = ground.near / 4.0;
    let level = |all: [&Vertex; 3]| {
        let [least, most] = range(all);
        let is_level = most - least < ground.near && all.iter().all(|v| looks_up(v, ground));
        (is_level && least - offset < DIP * (ground.height - offset)).then(|| (least, plan(all)))
    };
    let mut levels: Vec<(f64, f64)> = triangles().filter_map(level).collect();
    levels.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut rest = &levels[..];
    while let Some(&(height, _)) = rest.first() {
        let count = rest.partition_point(|(other, _)| *other < height + ground.near);
        let area: f64 = rest[..count].iter().map(|(_, area)| area).sum();
        rest = &rest[count..];
        if area > LARGE * extent {
            let is_below = |all: &[&Vertex; 3]| range(*all)[1] < height - ground.near;
            let below: f64 = triangles().filter(is_below).map(plan).sum();
            let is_of_it =
                |all: &[&Vertex; 3]| level(*all).is_some_and(|(at, _)| (at - height).abs() < ground.near);
            let corners = triangles().filter(is_of_it).flatten();
            let none = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
            let sides = corners.fold(none, |[low, high], v| {
                let at = [a, b].map(|k| f64::from(v.position[k]));
                [[0, 1].map(|k| low[k].min(at[k])), [0, 1].map(|k| high[k].max(at[k]))]
            });
            return Some(Floor { height, sides, is_slab: below >= LITTLE * area });
        }
    }
    None
}

/// The least and the greatest coordinates of places.
pub(crate) fn bounds(places: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for place in places {
        for axis in 0..3 {
            bounds[0][axis] = bounds[0][axis].min(place[axis]);
            bounds[1][axis] = bounds[1][axis].max(place[axis]);
        }
    }
    bounds
}

fn looks_up(v: &Vertex, ground: &Ground) -> bool {
    f64::from(v.normal[ground.up.0]) * ground.up.1 > 0.9
}

fn corners<'a>(model: &'a Model, triangle: &[u32; 3]) -> Option<[&'a Vertex; 3]> {
    let [a, b, c] = triangle.map(|index| model.vertices.get(index as usize));
    Some([a?, b?, c?])
}

/// The corners of a triangle that belongs to a floor: it is at the height of a ground, and looks up.
pub(super) fn floor_of<'a>(
    model: &'a Model,
    ground: &Ground,
    triangle: &[u32; 3],
) -> Option<[&'a Vertex; 3]> {
    let is_low = |v: &Vertex| (f64::from(v.position[ground.up.0]) - ground.low).abs() < ground.near;
    corners(model, triangle).filter(|all| all.iter().all(|v| is_low(v) && looks_up(v, ground)))
}

/// The place after the last part that has some of the floor.
pub(super) fn after(model: &Model, ground: &Ground) -> usize {
    let has_some = |part: &Part| part.triangles.iter().any(|all| floor_of(model, ground, all).is_some());
    model.parts.iter().rposition(has_some).map_or(0, |last| last + 1)
}

/// The floor's triangles on a ground, their corners three by three. A floor of few is in parts: as many as so many
/// squares along each side have.
pub(super) fn places(model: &Model, ground: &Ground, squares: u16) -> Vec<[f64; 3]> {
    let triangles = model.parts.iter().flat_map(|part| &part.triangles);
    let moved = |v: &Vertex| {
        let mut place = v.position.map(f64::from);
        place[ground.up.0] = ground.low;
        place
    };
    let [a, b] = others(ground.up.0);
    // As far as the ground goes.
    let around = |triangle: [[f64; 3]; 3]| {
        let mut places = triangle.to_vec();
        for (axis, low) in [a, b].into_iter().zip(ground.corner) {
            places = within(&places, |place| place[axis] - low);
            places = within(&places, |place| low + ground.side - place[axis]);
        }
        let fan = (2..places.len()).map(|k| [places[0], places[k - 1], places[k]]);
        fan.collect::<Vec<_>>()
    };
    let floor = triangles.filter_map(|triangle| Some(floor_of(model, ground, triangle)?.map(moved)));
    let floor: Vec<[[f64; 3]; 3]> = floor.flat_map(around).collect();
    let wanted = 2 * usize::from(squares).pow(2) / floor.len().max(1);
    let parts = Subdivision::new(u32::try_from(wanted.isqrt()).unwrap_or(1));
    let mut places = Vec::new();
    for corners in floor {
        for k in (0..).take(parts.triangles()) {
            places.extend(parts.triangle(k).map(|vertex| {
                let weights = parts.weights(vertex).map(f64::from);
                [0, 1, 2].map(|axis| weights.iter().zip(corners).map(|(w, corner)| w * corner[axis]).sum())
            }));
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Wrap;
    use crate::scene::Camera;
    use crate::scene::ground::{Manner, add};
    use crate::scene::normals::sub;

    /// Squares of these halves at these heights, which look up.
    fn squares(all: &[(f32, f32)]) -> Model {
        let mut model = Model::default();
        for &(half, y) in all {
            let first = u32::try_from(model.vertices.len()).expect("a few");
            let corner = |[x, z]: [f32; 2]| Vertex {
                position: [half * x, y, half * z],
                normal: [0.0, 1.0, 0.0],
                ..Vertex::default()
            };
            model.vertices.extend([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner));
            let triangles = [[0, 1, 2], [0, 2, 3]].map(|all| all.map(|k: u32| first + k)).to_vec();
            model.parts.push(Part { triangles, ..Part::default() });
        }
        model
    }

    fn first(model: &Model, swept: Option<&Reached>) -> Ground {
        grounds(model, swept, [0.0, 1.0, 0.0], DepthFormat::F32).into_iter().next().expect("a ground")
    }

    fn alpha(model: &Model, ground: &Ground, [x, z]: [f64; 2]) -> u8 {
        let [column, row, _] = ground.cells([x, 0.0, z]);
        let side = ground.cells as usize / 2;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
        let (column, row) = (column as usize / 2, row as usize / 2);
        ground.shadow(model, Wrap::default())[(side - 1 - row) * side + column]
    }

    /// A plate over a floor darkens it where it is above, as it does a ground.
    #[test]
    fn shadows_lie_on_a_floor() {
        let model = squares(&[(1.0, 0.0), (0.7, 0.4), (0.3, 0.2)]);
        let ground = first(&model, None);
        assert!(ground.on_floor && ground.low > 0.0 && ground.low < 1e-3, "{}", ground.low);
        let dark = alpha(&model, &ground, [0.0, 0.0]);
        assert!(dark > 60, "{dark}");
        assert!(alpha(&model, &ground, [0.8, 0.8]) < dark);
        assert!(alpha(&model, &ground, [0.97, 0.0]) > 4);
        // Without the floor the plates have a ground, whose shadow goes on there.
        let plates = squares(&[(0.01, 0.0), (0.7, 0.4), (0.3, 0.2)]);
        let below = first(&plates, None);
        assert!(!below.on_floor && below.low < 0.0);
        assert!(alpha(&plates, &below, [0.0, 0.0]).abs_diff(dark) < 20);
    }

    /// Things may dip into a floor, also in motion. A board that looks down, and a high floor are none.
    #[test]
    fn floors_are_low() {
        let found = |model: &Model, swept: Option<&Reached>| {
            let ground = first(model, swept);
            (ground.on_floor, ground.low)
        };
        let dipped = squares(&[(0.2, -0.1), (0.2, 1.0), (1.0, 0.0)]);
        let (is_floor, low) = found(&dipped, None);
        assert!(is_floor && low > 0.0 && low < 1e-3, "{low}");
        // Of all places that a model comes to there are no normals.
        let mut swept = Reached { whole: dipped.clone(), moving: Vec::new() };
        swept.whole.vertices.iter_mut().for_each(|v| v.normal = [0.0; 3]);
        assert_eq!(found(&dipped, Some(&swept)), (is_floor, low));
        // The squares that look down stand first.
        for (down, none) in [
            (0, &[(1.0, 0.8), (0.2, 0.0), (0.2, 1.0)][..]),
            (0, &[(0.3, 0.0), (1.0, 0.5)]),
            (1, &[(1.0, 0.0), (0.2, 1.0)]),
        ] {
            let mut model = squares(none);
            model.vertices[..4 * down].iter_mut().for_each(|v| v.normal[1] = -1.0);
            let (is_floor, low) = found(&model, None);
            assert!(!is_floor && low < 0.0, "{none:?} {low}");
        }
    }

    /// The upper side of a thin slab is bright but for the shadow of what stands there.
    #[test]
    fn thin_slabs_are_not_dark() {
        for thickness in [0.0002, 0.001, 0.01] {
            let mut slab = squares(&[(30.0, -thickness), (30.0, 0.0), (1.0, 1.0)]);
            slab.vertices[..4].iter_mut().for_each(|v| v.normal[1] = -1.0);
            let ground = first(&slab, None);
            assert!(ground.on_floor && ground.low > 0.0, "{thickness}");
            let [below, beside] = [[0.0, 0.0], [2.1, 2.1]].map(|at| alpha(&slab, &ground, at));
            assert!(below > 60 && beside < 20, "{thickness}: {below} {beside}");
        }
    }

    /// Beside a floor, things that reach below it have a ground of their own; all others have one with it.
    #[test]
    fn a_ground_goes_on_beyond_a_floor() {
        let of = |model: &Model| -> Vec<(bool, bool)> {
            let grounds = grounds(model, None, [0.0, 1.0, 0.0], DepthFormat::F32);
            grounds.iter().map(|ground| (ground.on_floor, ground.goes_on)).collect()
        };
        let mut model = squares(&[(1.0, 0.0), (0.2, 0.3), (0.3, 0.6)]);
        assert_eq!(of(&model), [(true, true)]);
        model.vertices[4..8].iter_mut().for_each(|v| v.position[0] += 1.1);
        assert_eq!(of(&model), [(true, true)]);
        // The shadow of what is beside the floor is there.
        let ground = first(&model, None);
        assert!(alpha(&model, &ground, [1.1, 0.0]) > 30, "{}", alpha(&model, &ground, [1.1, 0.0]));
        model.vertices[4..8].iter_mut().for_each(|v| v.position[1] = -0.1);
        assert_eq!(of(&model), [(true, false), (false, true)]);
        assert_eq!(of(&squares(&[(0.3, 0.0), (1.0, 0.5)])), [(false, true)]);
    }

    /// A slab has the shadow of what stands on it, and throws one around it.
    #[test]
    fn a_slab_is_a_floor_on_a_ground() {
        for thickness in [0.02, 0.1] {
            let mut model = squares(&[(1.0, -thickness), (1.0, 0.0), (0.3, 0.2), (0.3, 0.9)]);
            model.vertices[..4].iter_mut().for_each(|v| v.normal[1] = -1.0);
            let grounds = grounds(&model, None, [0.0, 1.0, 0.0], DepthFormat::F32);
            let [on_it, below] = grounds[..] else { panic!("{grounds:?}") };
            assert!(on_it.on_floor && !on_it.goes_on && !below.on_floor && below.goes_on);
            assert!(on_it.low > 0.0 && below.low < -f64::from(thickness));
            let [dark, light] = [[0.0, 0.0], [0.8, 0.8]].map(|at| alpha(&model, &on_it, at));
            assert!(dark > 60 && light < 20, "{dark} {light}");
            assert!(alpha(&model, &below, [1.02, 0.0]) > 4);
            // Without things there is the slab's own shadow.
            model.parts.truncate(2);
            let alone = super::grounds(&model, None, [0.0, 1.0, 0.0], DepthFormat::F32);
            assert!(alone.len() == 1 && !alone[0].on_floor, "{alone:?}");
        }
    }

    /// Without a depth buffer it is drawn after the floor, and before what stands on it.
    #[test]
    fn a_shadow_is_drawn_after_its_floor() {
        let mut model = squares(&[(1.0, 0.0), (0.9, 0.2)]);
        let mut camera = Camera {
            eye: [3.0, 2.0, 4.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 40.0,
            near: 4.0,
            far: 6.0,
        };
        let manner = Manner { depth: DepthFormat::None, ..Manner::default() };
        assert!(
            add(&mut model, (None, [0.0, 1.0, 0.0]), std::slice::from_mut(&mut camera), manner).is_some()
        );
        let names: Vec<&str> = model.parts.iter().map(|part| &*part.name).collect();
        assert_eq!(names, ["ground", "", "ground", ""]);
        // Around the floor it is below that, and between the planes.
        let around: Vec<_> =
            model.parts[0].triangles.iter().flatten().map(|k| model.vertices[*k as usize].position).collect();
        assert!(around.iter().all(|[x, y, _]| x.abs() > 1.2 && *y < 0.0 && *y > -1e-3), "{around:?}");
        assert!(camera.far > 6.0 && camera.near <= 4.0);
        // It ends where the floor does, and has the texel of each place: the middle is in the middle.
        let shadow = model.parts[2].triangles.iter().flatten().map(|k| model.vertices[*k as usize]);
        let corners: Vec<_> = shadow.map(|v| (v.position, v.uv)).collect();
        assert_eq!(corners.len(), 6);
        for ([x, y, z], [u, v]) in corners {
            assert!((x.abs() - 1.0).abs() < 1e-6 && (z.abs() - 1.0).abs() < 1e-6 && y > 0.0 && y < 1e-3);
            // The axes across the upward one are z and x.
            assert!((u - 0.5) * z > 0.1 && (v - 0.5) * x > 0.1, "{x} {z}: {u} {v}");
        }
    }

    /// Parts of a floor are as large as all of it, and lie where it does.
    #[test]
    fn a_floor_in_parts_is_the_floor() {
        let model = squares(&[(1.0, 0.0), (0.9, 0.2)]);
        let ground = first(&model, None);
        let area = |places: &[[f64; 3]]| -> f64 {
            let triangles = places.as_chunks::<3>().0.iter();
            triangles.map(|[a, b, c]| crate::scene::normals::cross(sub(*b, *a), sub(*c, *a))[1] / 2.0).sum()
        };
        let [one, many] = [1, 48].map(|squares| places(&model, &ground, squares));
        assert_eq!((one.len(), many.len()), (6, 2 * 48 * 48 * 3));
        // As the model's triangles they face down here; all of them do.
        assert!((area(&one).abs() - 4.0).abs() < 1e-6 && (area(&many) - area(&one)).abs() < 1e-5);
        assert!(
            many.iter().all(|[x, y, z]| x.abs().max(z.abs()) <= 1.0 + 1e-6 && (y - ground.low).abs() < 1e-9)
        );
    }
    /// However large a floor is, the shadow is that of what stands there, on as much of the floor.
    #[test]
    fn a_floor_as_large_as_may_be_has_the_shadow_of_its_things() {
        let near = squares(&[(1.0, 0.0), (0.3, 0.2)]);
        let ground = first(&near, None);
        for half in [20.0, 500.0, 1e4] {
            let far = squares(&[(half, 0.0), (0.3, 0.2)]);
            let other = first(&far, None);
            let off =
                [(ground.side, other.side), (ground.low, other.low), (ground.corner[0], other.corner[0])];
            assert!(off.iter().all(|(a, b)| (a - b).abs() < 1e-9), "{half}: {other:?}");
            assert_eq!(ground.shadow(&near, Wrap::Repeat), other.shadow(&far, Wrap::Repeat));
            let area: f64 = places(&far, &other, 1)
                .as_chunks::<3>()
                .0
                .iter()
                .map(|[a, b, c]| crate::scene::normals::cross(sub(*b, *a), sub(*c, *a))[1].abs() / 2.0)
                .sum();
            assert!((area / ground.side.powi(2) - 1.0).abs() < 1e-6, "{half}: {area}");
        }
        // Without things there is none.
        assert!(grounds(&squares(&[(1.0, 0.0)]), None, [0.0, 1.0, 0.0], DepthFormat::F32).is_empty());
    }
}
