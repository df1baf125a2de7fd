//! Tests of the making of normals.

use super::*;
use crate::scene::{Part, Vertex};

fn model(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Model {
    let vertex = |&position| Vertex { position, ..Vertex::default() };
    let part = Part { triangles: triangles.to_vec(), ..Part::default() };
    Model { vertices: positions.iter().map(vertex).collect(), parts: vec![part], ..Model::default() }
}

fn smooth(model: &mut Model) {
    by(model, Group::numbered(0), 0.0);
}

fn by(model: &mut Model, group: Group, crease: f32) {
    let groups = vec![group; model.parts.iter().map(|part| part.triangles.len()).sum()];
    complete(model, &groups, crease).unwrap();
}

fn close(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

#[test]
fn a_cube_corner_is_diagonal_however_its_faces_are_cut() {
    // Three unit squares at the origin, of which only one has its diagonal there.
    let positions =
        [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.], [1., 0., 1.]];
    let triangles = [[0, 2, 1], [0, 3, 2], [0, 5, 3], [3, 5, 4], [0, 1, 5], [1, 6, 5]];
    let mut model = model(&positions, &triangles);
    smooth(&mut model);
    let d = -1.0 / 3.0_f32.sqrt();
    assert!(close(model.vertices[0].normal, [d, d, d]), "{:?}", model.vertices[0].normal);
}

/// A cube of edges 2 whose edges are cut at 45 degrees, so far from them, as one polygon of triangles for each face.
fn bevelled(cut: f32) -> Model {
    let mut positions = Vec::new();
    let mut faces: Vec<Vec<u32>> = Vec::new();
    // A corner of the cube has three places, each on one face: the axis of which the coordinate is whole.
    let mut place = |signs: [f32; 3], axis: usize| {
        let position = [0, 1, 2].map(|k| signs[k] * if k == axis { 1.0 } else { 1.0 - cut });
        let found = positions.iter().position(|known| *known == position);
        u32::try_from(found.unwrap_or_else(|| {
            positions.push(position);
            positions.len() - 1
        }))
        .unwrap()
    };
    let signed = |axis: usize, own: f32, [a, b]: [f32; 2]| {
        let mut signs = [own; 3];
        (signs[(axis + 1) % 3], signs[(axis + 2) % 3]) = (a, b);
        signs
    };
    for axis in 0..3 {
        for own in [-1.0, 1.0] {
            let around = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            faces.push(around.map(|ab| place(signed(axis, own, ab), axis)).to_vec());
        }
        // The edges along this axis, between the faces of the other two.
        for [a, b] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            let [one, other] = [-1.0, 1.0].map(|own| signed(axis, own, [a, b]));
            let next = (axis + 1) % 3;
            let last = (axis + 2) % 3;
            faces.push(vec![place(one, next), place(other, next), place(other, last), place(one, last)]);
        }
    }
    for corner in 0..8 {
        let signs = [0, 1, 2].map(|k| if corner >> k & 1 == 0 { -1.0 } else { 1.0 });
        faces.push([0, 1, 2].map(|axis| place(signs, axis)).to_vec());
    }
    let mut triangles = Vec::new();
    for face in faces {
        for pair in face[1..].windows(2) {
            let triangle = [face[0], pair[0], pair[1]];
            let [a, b, c] = triangle.map(|i| positions[i as usize].map(f64::from));
            let outwards = dot(cross(sub(b, a), sub(c, a)), a) > 0.0;
            triangles.push(if outwards { triangle } else { [face[0], pair[1], pair[0]] });
        }
    }
    model(&positions, &triangles)
}

/// Large faces beside narrow bevels stay flat: no normal there turns by more than the bevel's share of the face.
#[test]
fn a_bevelled_cube_is_no_cushion() {
    for cut in [0.5, 0.2, 0.05, 0.001] {
        for group in [Group::BY_ANGLE, Group::numbered(1)] {
            let mut model = bevelled(cut);
            assert_eq!((model.vertices.len(), model.parts[0].triangles.len()), (24, 12 + 24 + 8));
            by(&mut model, group, 60.0);
            assert_eq!(model.vertices.len(), 24);
            for vertex in &model.vertices {
                let axis = (0..3).find(|&k| (vertex.position[k].abs() - 1.0).abs() < 1e-6).unwrap();
                let mut flat = [0.0; 3];
                flat[axis] = vertex.position[axis];
                let turn = length(cross(flat.map(f64::from), vertex.normal.map(f64::from))).asin();
                // A bevel is cut*sqrt(2) wide, of the face's 2, and turns by 45 degrees.
                assert!(turn < 2.0 * f64::from(cut), "{cut} {group:?}: {turn}");
                assert!(turn > 0.1 * f64::from(cut), "{cut} {group:?}: {turn}");
            }
        }
    }
}

/// Smooth edges one after the other do not join the sides of a box; those of an icosahedron all belong together.
#[test]
fn normals_are_of_what_turns_little() {
    // Two sides of a box, and a facet between them that ends in a point. It turns by 48 degrees from each.
    let positions = [[0.0; 3], [-1.0, 0.0, 0.0], [-0.5, -1.0, 0.0], [0.0, -1.0, -0.5], [0.0, 0.0, -1.0]];
    let mut corner = model(&positions, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    by(&mut corner, Group::BY_ANGLE, 60.0);
    let at_point = |k: usize| corner.vertices[corner.parts[0].triangles[k][0] as usize].normal;
    let [[x0, _, z0], facet, [x2, _, z2]] = [0, 1, 2].map(at_point);
    assert!(x0 < 0.8 * z0 && z2 < 0.8 * x2 && (x0 - z2).abs() < 1e-6, "{x0} {z0} {x2} {z2}");
    assert!((facet[0] - facet[2]).abs() < 1e-6, "{facet:?}");
    assert_eq!(corner.vertices.len(), 7);

    let g = f32::midpoint(1.0, 5.0_f32.sqrt());
    let corners = [-1.0_f32, 1.0].map(|a| [-g, g].map(|b| [[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]));
    let positions: Vec<[f32; 3]> = corners.into_iter().flatten().flatten().collect();
    let near = |a: usize, b: usize| {
        let apart = sub(positions[a].map(f64::from), positions[b].map(f64::from));
        (dot(apart, apart) - 4.0).abs() < 1e-3
    };
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in (b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(c, a)) {
                let [p, q, r] = [a, b, c].map(|k| positions[k].map(f64::from));
                let outwards = dot(cross(sub(q, p), sub(r, p)), p) > 0.0;
                let [a, b, c] = [a, b, c].map(|k| u32::try_from(k).unwrap());
                triangles.push(if outwards { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    assert_eq!(triangles.len(), 20);
    let mut ball = model(&positions, &triangles);
    by(&mut ball, Group::BY_ANGLE, 60.0);
    assert_eq!(ball.vertices.len(), 12);
    for vertex in &ball.vertices {
        let along = dot(normalize(vertex.position.map(f64::from)).unwrap(), vertex.normal.map(f64::from));
        assert!(along > 1.0 - 1e-6, "{along}");
    }
}

/// The wall of a cylinder in one group is as strong as its lids, however fine it is.
#[test]
fn lids_are_no_stronger_than_walls() {
    for sides in [8, 32, 128] {
        let mut tube = prism(sides);
        let lids = (1..sides - 1).flat_map(|k| [[1, 2 * k + 1, 2 * k + 3], [0, 2 * k + 2, 2 * k]]);
        tube.parts[0].triangles.extend(lids);
        smooth(&mut tube);
        // Angles of a wall are 180 degrees, and those of a lid less by a side's share of a turn.
        let slope = (1.0 - 2.0 / f64::from(sides)) / (std::f64::consts::PI / f64::from(sides)).cos();
        for vertex in &tube.vertices {
            let [x, y, z] = vertex.normal.map(f64::from);
            let off = z.abs() / (x * x + y * y).sqrt() / slope;
            assert!((off - 1.0).abs() < 1e-5, "{sides}: {off}");
        }
    }
}

/// A face that is cut into many triangles weighs as much as one of two.
#[test]
fn faces_weigh_alike_however_they_are_cut() {
    // A ramp of two units behind a floor one unit wide, in so many triangles each. It rises by 45 degrees.
    let step = |floor: u32, wall: u32| {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let mut strip = |count: u32, at: &dyn Fn(f32, f32) -> [f32; 3]| {
            let first = u32::try_from(positions.len()).unwrap();
            for i in 0..=count {
                let along = narrow(f64::from(i) / f64::from(count));
                positions.extend([at(along, 0.0), at(along, 1.0)]);
            }
            for i in 0..count {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| first + 2 * i + k);
                triangles.extend([[a, b, c], [b, d, c]]);
            }
        };
        strip(floor, &|x, y| [x, y, 0.0]);
        strip(wall, &|z, y| [-std::f32::consts::SQRT_2 * z, y, -std::f32::consts::SQRT_2 * z]);
        let mut model = model(&positions, &triangles);
        for triangle in &mut model.parts[0].triangles[2 * floor as usize..] {
            triangle.swap(1, 2);
        }
        smooth(&mut model);
        model.vertices[0].normal
    };
    let plain = step(1, 1);
    // Widths of 4*1/4 and 4*2/6.
    let across = 4.0 / 3.0 / std::f32::consts::SQRT_2;
    let slope = plain[0].abs() / plain[2].abs();
    assert!((slope - across / (1.0 + across)).abs() < 1e-5, "{plain:?}");
    for (floor, wall) in [(1, 7), (16, 1), (5, 64)] {
        assert!(close(step(floor, wall), plain), "{floor} {wall}");
    }
}

#[test]
fn vertices_at_one_position_share_a_normal() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [-0., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
    let mut model = model(&positions, &[[0, 1, 2], [3, 4, 5]]);
    smooth(&mut model);
    assert_eq!(model.vertices[0].normal, model.vertices[3].normal);
    let d = 0.5_f32.sqrt();
    assert!(close(model.vertices[0].normal, [d, 0.0, d]));
}

#[test]
fn given_normals_are_kept_and_made_unit() {
    let mut model = model(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]]);
    model.vertices[1].normal = [0.0, 3.0, 4.0];
    smooth(&mut model);
    assert!(close(model.vertices[0].normal, [0.0, 0.0, 1.0]));
    assert!(close(model.vertices[1].normal, [0.0, 0.6, 0.8]));
}

#[test]
fn degenerate_triangles_leave_a_unit_normal() {
    let mut model = model(&[[0., 0., 0.], [1e15, 0., 0.], [1e15, 0., 0.]], &[[0, 1, 2], [0, 0, 0]]);
    smooth(&mut model);
    assert_eq!(model.vertices[0].normal, [0.0, 0.0, 1.0]);
}

/// A prism over a regular polygon, without ends: two triangles a side.
fn prism(sides: u32) -> Model {
    let at = |i: u32, z: f32| {
        let angle = std::f64::consts::TAU * f64::from(i % sides) / f64::from(sides);
        [narrow(angle.cos()), narrow(angle.sin()), z]
    };
    let positions: Vec<_> = (0..sides).flat_map(|i| [at(i, 0.0), at(i, 1.0)]).collect();
    let around = |i: u32| i % (2 * sides);
    let triangles: Vec<_> = (0..sides)
        .flat_map(|i| {
            let [a, b, c, d] = [2 * i, around(2 * i + 2), around(2 * i + 3), 2 * i + 1];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    model(&positions, &triangles)
}

/// The normals at each corner of each triangle.
fn normals(model: &Model) -> Vec<[[f32; 3]; 3]> {
    all(model).map(|triangle| triangle.map(|i| model.vertices[i as usize].normal)).collect()
}

#[test]
fn edges_are_sharp_from_the_angle_on() {
    for sides in [3, 4, 5, 6, 7, 12, 40] {
        let turn = narrow(360.0 / f64::from(sides));
        for (crease, sharp) in [(turn - 0.1, true), (turn, true), (turn + 0.1, false), (180.0, false)] {
            let mut model = prism(sides);
            by(&mut model, Group::BY_ANGLE, crease);
            assert_eq!(
                model.vertices.len(),
                (if sharp { 4 } else { 2 }) * sides as usize,
                "{sides} {crease}"
            );
            for (i, triangle) in (0_u32..).zip(normals(&model)) {
                let middle = (turn * (narrow(f64::from(i / 2)) + 0.5)).to_radians();
                for (normal, index) in triangle.into_iter().zip(model.parts[0].triangles[i as usize]) {
                    let [x, y, _] = model.vertices[index as usize].position;
                    let wanted = if sharp { [middle.cos(), middle.sin(), 0.0] } else { [x, y, 0.0] };
                    assert!(close(normal, wanted), "{sides} {crease}: {normal:?} {wanted:?}");
                }
            }
        }
    }
}

#[test]
fn flat_faces_have_their_own_normals() {
    let mut model = prism(5);
    by(&mut model, Group::ALONE, 0.0);
    assert_eq!(model.vertices.len(), 30);
    for triangle in normals(&model) {
        assert!(triangle.iter().all(|&normal| close(normal, triangle[0])), "{triangle:?}");
    }
    // As polygons of two triangles each, they share corners within.
    let mut quads = prism(5);
    let groups: Vec<_> = (0..10).map(|i| Group::polygon(i / 2)).collect();
    complete(&mut quads, &groups, 0.0).unwrap();
    assert_eq!(quads.vertices.len(), 20);
    assert!(
        normals(&quads).iter().flatten().zip(normals(&model).iter().flatten()).all(|(a, b)| close(*a, *b))
    );
}

#[test]
fn groups_end_where_another_begins() {
    let mut model = prism(4);
    let groups: Vec<_> = [1, 1, 1, 1, 2, 2, 3, 3].map(Group::numbered).to_vec();
    complete(&mut model, &groups, 0.0).unwrap();
    // The edge within group 1 is smooth, the other three are sharp.
    assert_eq!(model.vertices.len(), 2 + 3 * 4);
    assert!(close(normals(&model)[0][1], [0.0, 1.0, 0.0]));
}

#[test]
fn the_sides_of_a_cone_are_smooth_at_its_tip() {
    // So many triangles at one position show whether that takes their square.
    let sides = 300_000_u32;
    let at = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(sides);
        [narrow(angle.cos()), narrow(angle.sin()), 0.0]
    };
    let positions: Vec<_> = (0..sides).map(at).chain([[0.0, 0.0, 1.0]]).collect();
    let triangles: Vec<_> = (0..sides).map(|i| [i, (i + 1) % sides, sides]).collect();
    let mut model = model(&positions, &triangles);
    by(&mut model, Group::BY_ANGLE, 60.0);
    assert_eq!(model.vertices.len(), positions.len());
    let tip = model.vertices[sides as usize].normal;
    assert!(tip[2] > 0.999, "{tip:?}");
}

#[test]
fn an_edge_of_many_triangles_joins_neighbours() {
    // Leaves of a book, each modelled on both sides.
    let leaves = 50_000_u32;
    let mut positions = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let mut triangles = Vec::new();
    for i in 0..leaves {
        let angle = narrow(f64::from(i) / f64::from(leaves));
        positions.push([angle.cos(), angle.sin(), 0.5]);
        triangles.extend([[0, 1, i + 2], [1, 0, i + 2]]);
    }
    let mut model = model(&positions, &triangles);
    by(&mut model, Group::BY_ANGLE, 60.0);
    for (triangle, normals) in all(&model).zip(normals(&model)) {
        let face = normalize(across(&model, triangle)).unwrap();
        let along = dot(face, normals[2].map(f64::from));
        assert!(along > 0.99, "{along}");
    }
}

#[test]
fn both_sides_of_a_sheet_keep_their_normals() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let mut model = model(&positions, &[[0, 1, 2], [2, 1, 0], [0, 2, 3], [3, 2, 0]]);
    by(&mut model, Group::BY_ANGLE, 60.0);
    assert_eq!(model.vertices.len(), 8);
    for (i, triangle) in normals(&model).into_iter().enumerate() {
        let up = if i % 2 == 0 { 1.0 } else { -1.0 };
        assert!(triangle.iter().all(|&normal| close(normal, [0.0, 0.0, up])), "{i}");
    }
}

#[test]
fn corners_without_area_split_nothing() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    let mut model = model(&positions, &[[0, 1, 1], [0, 1, 2], [2, 2, 0]]);
    by(&mut model, Group::BY_ANGLE, 60.0);
    assert!(model.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]) && model.vertices.len() == 3);
}

/// A funnel with a thin rim in one group: all around it, no corner's normal is on the other side of its triangle.
#[test]
fn rims_look_where_their_sides_do() {
    let outline = [(0.2, 0.0), (0.25, 1.0), (1.5, 2.0), (1.45, 2.0), (0.22, 1.0), (0.17, 0.0)];
    let sides = 48_u32;
    let places: Vec<[f32; 3]> = outline
        .iter()
        .flat_map(|&(radius, height): &(f32, f32)| {
            (0..sides).map(move |k| {
                let (sin, cos) = (f64::from(k) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
                [radius * narrow(cos), height, radius * narrow(sin)]
            })
        })
        .collect();
    let strips = (0..5).flat_map(|strip| {
        (0..sides).flat_map(move |k| {
            let [a, b] = [k, (k + 1) % sides].map(|k| strip * sides + k);
            [[a, a + sides, b + sides], [a, b + sides, b]]
        })
    });
    let mut funnel = model(&places, &strips.collect::<Vec<_>>());
    smooth(&mut funnel);
    for triangle in &funnel.parts[0].triangles {
        let own = normalize(across(&funnel, *triangle)).unwrap();
        for index in triangle {
            let along = dot(own, funnel.vertices[*index as usize].normal.map(f64::from));
            assert!(along > 0.1, "{triangle:?}: {along}");
        }
    }
}
