//! Prices as `cargo xtask` reads them off the boards.

use alberti_app::advise::Candidate;
use alberti_app::options::{Arithmetic, DepthFormat, Filter, Lod, Subpixel};

/// A policy's price on a scene of a board, or in code.
#[derive(Clone, Debug, PartialEq)]
pub struct Price {
    /// The board.
    pub board: String,
    /// The number of the scene's file; `None` for bytes of code.
    pub scene: Option<usize>,
    /// The policy's name.
    pub policy: String,
    /// Instructions of a frame, or bytes of code.
    pub count: u64,
    /// Divisions of a frame.
    pub divides: u64,
    /// Bytes of stack; 0 where they were not measured.
    pub stack: u64,
}

/// The fields of a line: names with commas are quoted.
pub fn parse(text: &str) -> Result<Vec<Price>, String> {
    let line = |line: &str| {
        let (first, rest) = line.split_once(",\"")?;
        let (policy, numbers) = rest.split_once("\",")?;
        let (board, scene) = first.split_once(',')?;
        let scene = if scene == "code" { None } else { Some(scene.parse().ok()?) };
        let mut numbers = numbers.split(',').map(|number| match number {
            "" => Some(0),
            number => number.parse().ok(),
        });
        let [count, divides, stack] = [numbers.next()??, numbers.next()??, numbers.next()??];
        Some(Price { board: board.to_owned(), scene, policy: policy.to_owned(), count, divides, stack })
    };
    text.lines().map(|text| line(text).ok_or_else(|| format!("found `{text}`, expected a price"))).collect()
}

/// A policy of the boards, by the parts of its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Policy {
    /// What the command calls it.
    pub candidate: Candidate,
    /// How the texture is read.
    pub filter: Filter,
    /// Where its levels are found.
    pub lod: Lod,
    /// What differs from the usual: 16 bits of depth, 4 of subpixels, the nearest texel.
    pub special: Option<Special>,
}

/// The part of a policy that is not the usual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Special {
    /// The depth format.
    Depth,
    /// The vertices' grid.
    Subpixel,
    /// The filter.
    Filter,
    /// Light from one direction, on normals that are interpolated.
    Light,
    /// Vertices of integers.
    Mesh,
    /// These with light at each.
    Vertex,
    /// Integers, and light on their normals, as what `alberti bake` writes is drawn.
    Baked,
}

impl Special {
    /// Whether it is a part of what `alberti bake` writes, which `alberti advise` does not ask for.
    pub fn is_of_baked(self) -> bool {
        matches!(self, Self::Light | Self::Mesh | Self::Vertex | Self::Baked)
    }
}

/// What is special of baked meshes, as it is called.
const BAKED: [(&str, Special); 4] = [
    ("lambert", Special::Light),
    ("integers", Special::Mesh),
    ("integers vertex", Special::Vertex),
    ("integers lambert", Special::Baked),
];

/// The depth formats beside the usual, as they are called.
const DEPTHS: [(&str, DepthFormat); 5] = [
    ("none", DepthFormat::None),
    ("u24", DepthFormat::U24),
    ("u32", DepthFormat::U32),
    ("f32", DepthFormat::F32),
    ("f32-reversed", DepthFormat::F32Reversed),
];

/// The places of levels of detail, as they are called.
const LODS: [(&str, Lod); 3] = [("pixel", Lod::Pixel), ("run", Lod::Run), ("triangle", Lod::Triangle)];

/// The policy of a name such as `fixed spans:16, u24`.
pub fn policy(name: &str) -> Option<Policy> {
    let (lines, special) =
        name.split_once(", ").map_or((name, None), |(lines, special)| (lines, Some(special)));
    let (arithmetic, interpolation) = lines.split_once(' ')?;
    let candidate = Candidate {
        interpolation: interpolation.parse().ok()?,
        arithmetic: if arithmetic == "fixed" { Arithmetic::Fixed } else { Arithmetic::Float },
        subpixel: Subpixel::Sub4,
        depth: DepthFormat::U16,
    };
    let usual = Policy { candidate, filter: Filter::Nearest, lod: Lod::default(), special: None };
    let Some(word) = special else { return Some(usual) };
    if let Some(&(_, depth)) = DEPTHS.iter().find(|(name, _)| *name == word) {
        let candidate = Candidate { depth, ..candidate };
        return Some(Policy { candidate, special: Some(Special::Depth), ..usual });
    }
    if word == "8" {
        let candidate = Candidate { subpixel: Subpixel::Sub8, ..candidate };
        return Some(Policy { candidate, special: Some(Special::Subpixel), ..usual });
    }
    if let Some(&(_, special)) = BAKED.iter().find(|(name, _)| *name == word) {
        return Some(Policy { special: Some(special), ..usual });
    }
    let (filter, lod) = word.split_once(':').map_or((word, None), |(filter, lod)| (filter, Some(lod)));
    let lod = match lod {
        None => Lod::default(),
        Some(lod) => LODS.iter().find(|(name, _)| *name == lod)?.1,
    };
    Some(Policy { filter: filter.parse().ok()?, lod, special: Some(Special::Filter), ..usual })
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_app::options::{Interpolation, SpanLength};

    #[test]
    fn lines_are_read() {
        let found =
            parse("m0,3,\"fixed affine\",12,4,300\nm0,code,\"float exact, u24\",17,,\n").expect("prices");
        let price = |scene, policy: &str, [count, divides, stack]: [u64; 3]| Price {
            board: "m0".into(),
            scene,
            policy: policy.into(),
            count,
            divides,
            stack,
        };
        let expected =
            [price(Some(3), "fixed affine", [12, 4, 300]), price(None, "float exact, u24", [17, 0, 0])];
        assert_eq!(found, expected);
        assert!(parse("m0,x,\"a\",1,2,3\n").unwrap_err().contains("expected a price"));
    }

    #[test]
    fn names_are_policies() {
        let found = policy("fixed spans:16, u24").expect("a policy");
        assert_eq!(found.candidate.interpolation, Interpolation::Spans(SpanLength::Sixteen));
        assert_eq!((found.candidate.depth, found.special), (DepthFormat::U24, Some(Special::Depth)));
        assert_eq!(policy("float exact, 8").expect("a policy").candidate.subpixel, Subpixel::Sub8);
        let found = policy("fixed spans:16, trilinear:run").expect("a policy");
        assert_eq!((found.filter, found.lod), (Filter::Trilinear, Lod::Run));
        let special = |name| policy(name).expect("a policy").special;
        assert_eq!(special("float exact, lambert"), Some(Special::Light));
        assert_eq!(special("fixed spans:16, integers vertex"), Some(Special::Vertex));
        assert_eq!(special("fixed spans:16, integers lambert"), Some(Special::Baked));
        assert!(
            policy("float exact, trilinear:row").is_none()
                && policy("fixed spans:7").is_none()
                && policy("exact").is_none()
        );
    }
}
