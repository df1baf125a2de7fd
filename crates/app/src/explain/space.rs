//! The steps before the screen: object, eye, pyramid, near and far, perspective, viewport.

use super::report::{Block, Cell};
use super::{Fragment, Scene, theory};
use alberti::glam::Vec3;
use alberti::projection::{EyeVertex, Polygon, ProjectedVertex, SideBounds, clip_near_far, clip_sides};
use alberti::{AnyProjection, Eye, Fixed, Point3, Projection as _};

/// The names of the corners of what is left of a triangle.
const CORNERS: [&str; 9] = ["A", "B", "C", "D", "E", "F", "G", "H", "I"];

impl Scene<'_> {
    /// All of them.
    pub(super) fn in_space(&self, fragment: &Fragment<'_>) -> Vec<Block> {
        let points = fragment.vertices.map(|v| Point3::new(Vec3::from_array(v.position)));
        let eye = points.map(|p| self.to_eye.to_parent(p));
        let scaled = eye.map(|p| self.projection.scale(p));
        let left = self.between(scaled);
        vec![
            self.object(fragment),
            self.eye(&eye),
            self.pyramid(&scaled),
            self.near_far(&scaled, &left),
            self.perspective(&left),
            self.viewport(fragment),
        ]
    }

    fn object(&self, fragment: &Fragment<'_>) -> Block {
        let mut block = Block::new(
            "object",
            "the triangle, in object space, which is the world's",
            &[theory::CHANGE_OF_FRAME],
        );
        block.value("part", "part", fragment.arrival.part);
        if !fragment.part.name.is_empty() {
            block.value("name", "its name", fragment.part.name.as_str());
        }
        block.value("triangle", "triangle of the part", fragment.arrival.triangle);
        block.values("vertices", "vertices of the model", fragment.indices);
        if fragment.origin.iter().any(|x| x.abs() > 0.0) {
            block.values("origin", "counted from, in the file", fragment.origin);
        }
        for ((key, label), v) in KEYS.into_iter().zip(fragment.vertices) {
            block.values(key, label, v.position);
        }
        block
    }

    fn eye(&self, eye: &[Point3<Eye>; 3]) -> Block {
        let mut block = Block::new("eye", "in eye space: x right, y up, z forward", &[theory::EYE]);
        block.values("eye", "the eye, in the world", self.camera.eye);
        for ((key, label), p) in KEYS.into_iter().zip(eye) {
            block.values(key, label, p.coords.to_array());
        }
        block
    }

    fn pyramid(&self, scaled: &[Point3<Eye>; 3]) -> Block {
        let perspective = self.projection.is_perspective();
        let (title, relation) = if perspective {
            ("pyramid scale: the sides of the view become x = ±z, y = ±z", &[theory::PYRAMID])
        } else {
            ("scaled to the window: the sides of the view become x = ±1, y = ±1", &[theory::PARALLEL])
        };
        let mut block = Block::new("scaled", title, relation);
        let [x, y, _] = self.projection.scale(Point3::new(Vec3::ONE)).coords.to_array();
        block.values("scale", "factors of x and y", [x, y]);
        for ((key, label), p) in KEYS.into_iter().zip(scaled) {
            block.values(key, label, p.coords.to_array());
        }
        block
    }

    /// The polygon between near and far, and the weights of the three vertices at its corners.
    fn between(&self, [a, b, c]: [Point3<Eye>; 3]) -> Polygon<EyeVertex<Vec3>> {
        let vertex = |position, varying| EyeVertex { position, varying };
        let triangle = [vertex(a, Vec3::X), vertex(b, Vec3::Y), vertex(c, Vec3::Z)];
        clip_near_far(triangle, self.projection.near(), self.projection.far())
    }

    fn near_far(&self, scaled: &[Point3<Eye>; 3], left: &Polygon<EyeVertex<Vec3>>) -> Block {
        let mut block = Block::new("clip", "clip at the near and the far plane", &[theory::NEAR_FAR]);
        let [near, far] = [self.projection.near(), self.projection.far()];
        block.values("planes", "z = A and z = B", [near, far]);
        let (before, behind) =
            (scaled.iter().any(|p| p.coords.z < near), scaled.iter().any(|p| p.coords.z > far));
        let cut = match (before, behind) {
            (false, false) => "by neither: all three vertices are between the planes",
            (true, false) => "by the near plane",
            (false, true) => "by the far plane",
            (true, true) => "by both planes",
        };
        block.value("cut", "cut", cut);
        if before || behind {
            block.note("left", format!("what is left has {} corners:", left.vertices().len()));
            let row = |(name, v): (&&str, &EyeVertex<Vec3>)| {
                let numbers = v.position.coords.to_array().into_iter().chain(v.varying.to_array());
                [Cell::from(*name)].into_iter().chain(numbers.map(Cell::from)).collect()
            };
            let columns = ["corner", "x", "y", "z", "of the 1st", "of the 2nd", "of the 3rd"];
            block.table("corners", &columns, CORNERS.iter().zip(left.vertices()).map(row).collect());
        }
        block
    }

    fn perspective(&self, left: &Polygon<EyeVertex<Vec3>>) -> Block {
        let reversed = alberti::DepthFormat::reversed(crate::render::any_depth(self.options.depth));
        let mut block = match self.projection {
            AnyProjection::Perspective(perspective) => {
                let title = "perspective with depth: xs = x/z, ys = y/z, zs = α + β/z, q = 1/z";
                let mut block = Block::new("projected", title, &[theory::DIVISION, theory::PLANES_AB]);
                let map = perspective.depth_map(reversed);
                block.values("alpha_beta", "α and β", [map.alpha(), map.beta()]);
                block
            }
            AnyProjection::Parallel(_) => {
                let title = "parallel projection: xs = x, ys = y, q = 1";
                Block::new("projected", title, &[theory::PARALLEL, theory::LINEAR_DEPTH])
            }
        };
        let projected = left.map(|v| self.projection.project(&reversed, &v));
        let row = |(name, v): (&&str, &ProjectedVertex<Vec3>)| {
            let numbers = [v.x, v.y, v.zs, v.q];
            [Cell::from(*name)].into_iter().chain(numbers.map(Cell::from)).collect()
        };
        let columns = ["corner", "xs", "ys", "zs", "q"];
        block.table("corners", &columns, CORNERS.iter().zip(projected.vertices()).map(row).collect());
        let SideBounds { x, y } = self.viewport.guard();
        let beyond = |v: &ProjectedVertex<Vec3>| v.x.abs() > x || v.y.abs() > y;
        if projected.vertices().iter().any(beyond) {
            let left = clip_sides(projected, SideBounds { x, y });
            let corners = left.vertices().len();
            block.relations = &[theory::DIVISION, theory::SIDES];
            block
                .note("guard", format!("cut at the guard band, |xs| <= {x}, |ys| <= {y}: {corners} corners"));
        }
        block
    }

    /// Places on the screen, of the part that covers the pixel.
    fn viewport(&self, fragment: &Fragment<'_>) -> Block {
        let mut block = Block::new(
            "viewport",
            "viewport: x = (xs + 1) W/2, y = (1 - ys) H/2, snapped to subpixels",
            &[theory::VIEWPORT],
        );
        let Some(piece) = fragment.pieces.get(fragment.number) else { return block };
        if !fragment.shape.is_whole() {
            let of = fragment.pieces.len();
            block.note("part", format!("part {} of the {of} that clipping has left", fragment.number + 1));
        }
        let one = f64::from(1 << self.drawing.subpixel().bits());
        let pixels = |x: Fixed| f64::from(x.subpixels()) / one;
        let moved = |x: Fixed| -f64::from(x.moved()) / 256.0 / one;
        let row = |(name, corner): (&str, &crate::draw::Corner3)| {
            vec![
                name.into(),
                pixels(corner.x).into(),
                pixels(corner.y).into(),
                corner.x.subpixels().into(),
                corner.y.subpixels().into(),
                moved(corner.x).into(),
                moved(corner.y).into(),
                corner.zs.into(),
                corner.q.into(),
            ]
        };
        let columns =
            ["corner", "x", "y", "x subpixels", "y subpixels", "x moved by", "y moved by", "zs", "q"];
        block.table("corners", &columns, ["P", "Q", "R"].into_iter().zip(&piece.given).map(row).collect());
        if self.is_fixed() {
            block
                .note("fixed", "in fixed point places are subpixels alone: what snapping moved is not known");
        }
        block
    }
}

/// The keys and labels of a triangle's vertices.
const KEYS: [(&str, &str); 3] = [("first", "1st vertex"), ("second", "2nd vertex"), ("third", "3rd vertex")];
