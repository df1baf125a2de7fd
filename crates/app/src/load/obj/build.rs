//! From a file's faces to the vertices and triangles of a model.

use std::collections::HashMap;

use super::block::{Corner, Event, WHITE};
use super::read::ObjText;
use super::{DEFAULT_DIFFUSE, KIND};
use crate::error::Error;
use crate::options::Normals;
use crate::scene::normals::{Group, cross, narrow, sub};
use crate::scene::origin;
use crate::scene::polygon::triangulate;
use crate::scene::{Model, Part, Vertex};

/// Links that are followed at a position before a table is asked.
const SHORT: usize = 8;

/// A model whose normals may be missing, and what is known of it.
#[derive(Debug, Default)]
pub(crate) struct Built {
    pub(crate) model: Model,
    /// The material of each part.
    pub(crate) materials: Vec<Option<usize>>,
    /// The company of each triangle, in the parts' order.
    pub(crate) groups: Vec<Group>,
    /// The polygons that cross themselves, and the line of the first.
    pub(crate) crossing: (usize, usize),
    /// Whether any triangle has an area.
    pub(crate) has_area: bool,
}

/// Builds the parts in the file's order: a new one begins at each object and at each change of material. `materials`
/// are their names and numbers. `made` says how normals are made, whatever the file has; without it they are those of
/// the file.
///
/// # Errors
/// There are too many vertices.
pub(crate) fn build(
    mut text: ObjText,
    materials: &HashMap<String, usize>,
    made: Option<Normals>,
) -> Result<Built, Error> {
    let origin = origin::of(text.positions.iter().copied());
    let mut builder = Builder {
        out: Built::default(),
        vertices: Vertices::new(&text, origin),
        name: String::new(),
        material: None,
        smoothing: None,
        triangles: Vec::new(),
        polygons: 0,
        made,
    };
    builder.out.model.origin = origin;
    let (mut points, mut cut) = (Vec::new(), Vec::new());
    for faces in std::mem::take(&mut text.faces) {
        let (mut events, mut rest) = (faces.events.into_iter().peekable(), &faces.corners[..]);
        for (number, face) in faces.faces.iter().enumerate() {
            while let Some((_, event)) = events.next_if(|(at, _)| *at <= number) {
                builder.obey(event, materials);
            }
            let (corners, after) = rest.split_at(face.corners as usize);
            rest = after;
            points.clear();
            points.extend(corners.iter().map(|&[v, _, _]| text.positions[v as usize - 1]));
            cut.clear();
            if !triangulate(&points, &mut cut) {
                let (count, line) = &mut builder.out.crossing;
                *line = if *count == 0 { face.line as usize } else { *line };
                *count += 1;
            }
            builder.face(&text, corners, &points, &cut)?;
        }
        events.for_each(|(_, event)| builder.obey(event, materials));
    }
    builder.end_part();
    let mut built = builder.out;
    built.model.vertices = builder.vertices.all;
    Ok(built)
}

struct Builder {
    out: Built,
    vertices: Vertices,
    name: String,
    material: Option<usize>,
    /// The group of `s`; `None` before any.
    smoothing: Option<u32>,
    triangles: Vec<[u32; 3]>,
    polygons: u32,
    made: Option<Normals>,
}

impl Builder {
    fn obey(&mut self, event: Event, materials: &HashMap<String, usize>) {
        match event {
            Event::Object(name) => {
                self.end_part();
                self.name = name;
            }
            Event::Material(name, _) => {
                let material = materials.get(&name).copied();
                if material != self.material {
                    self.end_part();
                    self.material = material;
                }
            }
            Event::Smoothing(group) => self.smoothing = Some(group),
        }
    }

    fn end_part(&mut self) {
        self.vertices.part_begins();
        if self.triangles.is_empty() {
            return;
        }
        let (name, triangles) = (self.name.clone(), std::mem::take(&mut self.triangles));
        self.out.model.parts.push(Part { name, triangles, diffuse: DEFAULT_DIFFUSE, ..Part::default() });
        self.out.materials.push(self.material);
    }

    fn face(
        &mut self,
        text: &ObjText,
        corners: &[Corner],
        points: &[[f64; 3]],
        cut: &[[u32; 3]],
    ) -> Result<(), Error> {
        let group = match (self.made, self.smoothing) {
            (Some(Normals::Smooth), _) => Group::numbered(0),
            (Some(Normals::Crease(_)), _) | (None, None) => Group::BY_ANGLE,
            (Some(Normals::Flat), _) | (None, Some(0)) if cut.len() == 1 => Group::ALONE,
            (Some(Normals::Flat), _) | (None, Some(0)) => {
                self.polygons = self.polygons.wrapping_add(1);
                Group::polygon(self.polygons)
            }
            (None, Some(number)) => Group::numbered(number),
        };
        let first = self.vertices.corners.len();
        for &[v, vt, vn] in corners {
            let index = self.vertices.index(text, [v, vt, if self.made.is_some() { 0 } else { vn }])?;
            self.vertices.corners.push(index);
        }
        let index = |i: u32| self.vertices.corners[first + i as usize];
        self.triangles.extend(cut.iter().map(|triangle| triangle.map(index)));
        self.vertices.corners.truncate(first);
        self.out.groups.extend(std::iter::repeat_n(group, cut.len()));
        self.out.has_area = self.out.has_area
            || cut.iter().any(|triangle| {
                let [a, b, c] = triangle.map(|i| points[i as usize]);
                cross(sub(b, a), sub(c, a)).iter().any(|x| x.abs() > 0.0)
            });
        Ok(())
    }
}

/// The vertices so far. Those of a part that have the same indices are one.
struct Vertices {
    all: Vec<Vertex>,
    /// Of each vertex: its texture coordinate, its normal, and the vertex before it at its position.
    keys: Vec<[u32; 3]>,
    /// The last vertex at each position.
    last: Vec<u32>,
    /// Those of positions that have many.
    table: HashMap<Corner, u32>,
    /// The part's first vertex.
    first: u32,
    origin: [f64; 3],
    /// The vertices of a face.
    corners: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Vertices {
    fn new(text: &ObjText, origin: [f64; 3]) -> Self {
        let (last, table) = (vec![NONE; text.positions.len()], HashMap::new());
        Self { all: Vec::new(), keys: Vec::new(), last, table, first: 0, origin, corners: Vec::new() }
    }

    fn part_begins(&mut self) {
        self.first = u32::try_from(self.all.len()).unwrap_or(NONE);
        self.table.clear();
    }

    fn index(&mut self, text: &ObjText, corner: Corner) -> Result<u32, Error> {
        let [v, vt, vn] = corner;
        let last = self.last[v as usize - 1];
        // Vertices of earlier parts are not shared.
        let of_part = |index: u32| index != NONE && index >= self.first;
        let (mut at, mut links) = (last, 0);
        while of_part(at) && links < SHORT {
            let [t, n, before] = self.keys[at as usize];
            if (t, n) == (vt, vn) {
                return Ok(at);
            }
            (at, links) = (before, links + 1);
        }
        if of_part(at)
            && let Some(&index) = self.table.get(&corner)
        {
            return Ok(index);
        }
        let index = u32::try_from(self.all.len()).ok().filter(|&index| index < NONE).ok_or_else(|| {
            Error::new("more than 4 billion vertices", format!("{KIND} with fewer")).hint("reduce the model")
        })?;
        if links == SHORT {
            // The first that the chain is too long for brings all before it along.
            let mut older = if of_part(at) { NONE } else { last };
            while of_part(older) {
                let [t, n, before] = self.keys[older as usize];
                self.table.insert([v, t, n], older);
                older = before;
            }
            self.table.insert(corner, index);
        }
        self.keys.push([vt, vn, last]);
        self.last[v as usize - 1] = index;
        let of = |index: u32| (index as usize).checked_sub(1);
        let v = v as usize - 1;
        self.all.push(Vertex {
            position: sub(text.positions[v], self.origin).map(narrow),
            normal: of(vn).map_or([0.0; 3], |i| text.normals[i]),
            uv: of(vt).map_or([0.0; 2], |i| text.uvs[i]),
            color: text.colors.get(v).copied().unwrap_or(WHITE),
            ..Vertex::default()
        });
        Ok(index)
    }
}
