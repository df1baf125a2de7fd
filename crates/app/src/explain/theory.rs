//! The rows of docs/theory.md that steps follow.

/// A row: its section, and words of it that tell it from the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Relation {
    /// The heading.
    pub(crate) section: &'static str,
    /// Short: its label, or a name.
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
    CHANGE_OF_FRAME: "Frames", "F1", "| **F1** Change of frame";
    EYE: "The view pipeline", "V1", "| **V1** From object to eye";
    PYRAMID: "The view pipeline", "V2", "| **V2** Pyramid scale";
    NEAR_FAR: "The view pipeline", "V3", "| **V3** Clip near and far";
    DIVISION: "The view pipeline", "(1)", "| **(1)** Perspective with depth";
    SIDES: "The view pipeline", "V5", "| **V5** Clip the cube's sides";
    VIEWPORT: "The view pipeline", "V6", "| **V6** Window to viewport";
    Z_BUFFER: "The view pipeline", "the z-buffer", "the z-buffer";
    AREAS: "Barycentric coordinates", "B3", "| **B3** In the plane, ratios of areas";
    EDGES: "Barycentric coordinates", "B5", "| **B5** A sample is in a triangle";
    TIES: "Barycentric coordinates", "top and left edges", "a top or a left edge";
    ONE_OVER_Z: "Perspective with depth", "(9)", "| **(9)** 1/z is linear";
    INVERSES: "Perspective with depth", "P4", "| **P4** The inverses of (6) to (8)";
    DEPTH: "Perspective with depth", "(10)", "| **(10)** Depth comes back";
    PLANES_AB: "The depth map", "(11)", "| **(11)** [A, B] to [0, 1]";
    RESOLUTION: "The depth map", "D5", "| **D5** Resolution";
    DRAWN_RESOLUTION: "The depth map", "D7", "| **D7** The δ of surfaces as they are drawn";
    PARALLEL: "The depth map", "L1", "| **L1** Scaled to the window";
    LINEAR_DEPTH: "The depth map", "L2", "| **L2** Depth";
    HYPERBOLIC: "Hyperbolic interpolation", "H1", "| **H1** Interpolate t/w and 1/w";
    AFFINE: "Hyperbolic interpolation", "affine", "| α' t1 + β' t2 + γ' t3";
    TEXTURE: "Textures", "T1", "| **T1** A place in the texture";
    NEAREST: "Textures", "nearest", "Nearest: the texel whose cell holds the place";
    BILINEAR: "Textures", "T2", "| **T2** Bilinear";
    LEVEL: "Textures", "T4", "| **T4** The level";
    DERIVATIVES: "Textures", "T5", "| **T5** Derivatives of a quotient";
    TRILINEAR: "Textures", "T7", "| **T7** Trilinear";
    COLOR_MAP: "Textures", "colour", "| Colour: what is scattered";
    SLIDE: "Projectors", "J4", "| **J4** Vertices carry u, v and q";
    SUNLIGHT: "Light", "G1", "| **G1** Light from one direction";
    LAMPS: "Light", "G2", "| **G2** Several lights";
    VERTEX_COLOR: "Interpolation", "I2", "| **I2** Colour at a point";
}
