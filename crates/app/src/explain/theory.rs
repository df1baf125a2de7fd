//! The rows of docs/theory.md that steps follow.

/// A row: its section, and words of it that tell it from the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Relation {
    /// The heading.
    pub(crate) section: &'static str,
    /// Short: the number of a step or of a relation, or a name.
    pub(crate) row: &'static str,
    /// Words of the row.
    pub(crate) words: &'static str,
}

impl Relation {
    /// `section, row`.
    pub(crate) fn name(&self) -> String {
        if self.row.is_empty() { self.section.to_owned() } else { format!("{}, {}", self.section, self.row) }
    }
}

macro_rules! relations {
    ($($name:ident: $section:literal, $row:literal, $words:literal;)+) => {
        $(pub(crate) const $name: Relation = Relation { section: $section, row: $row, words: $words };)+

        /// All of them.
        #[cfg(test)]
        pub(crate) const ALL: &[Relation] = &[$($name),+];
    };
}
relations! {
    CHANGE_OF_FRAME: "Frames", "change of frame", "| Change of frame: a point goes to";
    EYE: "The view pipeline", "1", "| 1. From object to eye coordinates";
    PYRAMID: "The view pipeline", "2", "| 2. Pyramid scale";
    NEAR_FAR: "The view pipeline", "3", "| 3. Clip against z = A and z = B";
    DIVISION: "The view pipeline", "4", "| 4. Perspective with depth";
    SIDES: "The view pipeline", "5", "| 5. Clip against the cube's sides";
    VIEWPORT: "The view pipeline", "6", "| 6. Window-viewport";
    Z_BUFFER: "The view pipeline", "the z-buffer", "the z-buffer";
    AREAS: "Barycentric coordinates", "ratios of areas", "| In the plane, ratios of areas";
    EDGES: "Barycentric coordinates", "left of every edge", "left of every edge";
    TIES: "Barycentric coordinates", "top and left edges", "a top or a left edge";
    ONE_OVER_Z: "Perspective with depth", "(9)", "= 1/z (9)";
    INVERSES: "Perspective with depth", "(6 to 8)", "| Inverses of (6 to 8)";
    DEPTH: "Perspective with depth", "(10)", "| Depth comes back";
    PLANES_AB: "Perspective with depth", "(11)", "(11)";
    RESOLUTION: "Perspective with depth", "resolution", "| Resolution: a step";
    DRAWN_RESOLUTION: "Perspective with depth", "as they are drawn", "| Of surfaces as they are drawn";
    PARALLEL: "Perspective with depth", "parallel projection", "| xs = x and ys = y";
    LINEAR_DEPTH: "Perspective with depth", "parallel depth", "| zs = (z − A)/(B − A)";
    HYPERBOLIC: "Hyperbolic interpolation", "", "t = (α' t1/w1";
    AFFINE: "Hyperbolic interpolation", "affine", "| α' t1 + β' t2 + γ' t3";
    TEXTURE: "Textures", "(u W, v H)", "| A texture of W x H texels";
    NEAREST: "Textures", "nearest", "| Magnification, nearest";
    BILINEAR: "Textures", "bilinear", "| Magnification, bilinear";
    LEVEL: "Textures", "the level", "| The level: λ";
    DERIVATIVES: "Textures", "derivatives", "| Derivatives of u";
    TRILINEAR: "Textures", "trilinear", "| Trilinear:";
    COLOR_MAP: "Textures", "colour", "| Colour: what is scattered";
    SLIDE: "Textures", "fragments divide", "| Fragments divide";
    SUNLIGHT: "Light", "from one direction", "| Light from one direction";
    LAMPS: "Light", "several lights", "| Several lights";
    VERTEX_COLOR: "Interpolation", "colour", "| Colour: c =";
}
