//! Sweeps: every case there is, or as many hard ones as there is time for, against an oracle.
//!
//! A [`Sweep`] is a row of blocks, each of which is a function of its number and of a seed. So it can be done in shards
//! by several machines, and go on where it was stopped. `cargo xtask sweep` lists them.

pub mod cases;
pub mod run;

/// The outcome of a block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Found {
    /// Cases that were looked at.
    pub cases: u64,
    /// The greatest error, in the sweep's unit.
    pub worst: f64,
}

impl Found {
    /// Both together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { cases: self.cases + other.cases, worst: self.worst.max(other.worst) }
    }
}

/// A row of blocks.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// By what it is asked for.
    pub name: &'static str,
    /// A line for people.
    pub about: &'static str,
    /// The unit of errors, and the bound that they keep; nothing where answers are equal.
    pub unit: &'static str,
    /// Blocks of the whole.
    pub blocks: u64,
    /// Looks at a block: what was found, or the first case that breaks a promise.
    pub block: fn(u64, u64) -> Result<Found, String>,
}

/// All sweeps.
pub const SWEEPS: &[Sweep] = &[
    Sweep {
        name: "triangles",
        about: "all 1,291,467,969 triangles of 2x2 pixels on the grid of 16ths: which of four samples they cover",
        unit: "",
        blocks: cases::triangles::POINTS,
        block: cases::triangles::block,
    },
    Sweep {
        name: "coverage",
        about: "10^10 samples on, beside and near edges up to the guard band, on both grids",
        unit: "",
        blocks: 40_000,
        block: cases::coverage::block,
    },
    Sweep {
        name: "attributes",
        about: "10^9 values and depths in perspective against 106 bits, and the worst of each block uphill",
        unit: "units of 2^-24 of the greatest value; 9 for values, 6 for depths",
        blocks: 5_000,
        block: cases::attributes::block,
    },
    Sweep {
        name: "rationals",
        about: "each function of docs/accuracy.md against rationals, and the worst of each block uphill",
        unit: "shares of the documented bound",
        blocks: 20_000,
        block: cases::rationals::block,
    },
    Sweep {
        name: "clip",
        about: "10^9 edges over a plane in two triangles: one new vertex, the same from both",
        unit: "",
        blocks: 2_000,
        block: cases::clip::block,
    },
    Sweep {
        name: "depth",
        about: "every f32 between near and far of 64 pairs: no later depth comes before an earlier one, in all formats",
        unit: "",
        blocks: 64 * cases::depth::PARTS,
        block: cases::depth::block,
    },
    Sweep {
        name: "floats",
        about: "all 2^32 floats through each function of one: places in textures, bytes, fixed point",
        unit: "",
        blocks: 1 << 12,
        block: cases::floats::block,
    },
    Sweep {
        name: "tangents",
        about: "10^7 meshes: tangents are unit vectors, across the normal, and those of f64",
        unit: "units of 2^-24",
        blocks: 1_000,
        block: cases::tangents::block,
    },
];
