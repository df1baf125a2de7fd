//! The model of what a frame costs a chip: so many instructions for each vertex, row, fragment and so on.
//!
//! The table of coefficients was fitted to frames that emulated boards drew. A line of kind `lines` is the cost of a
//! textured, unlit mesh with 16-bit depths, 4 bits of subpixels, the nearest texel and RGB565. The others are
//! differences from that, which add up.

use super::Work;
use super::candidate::{Candidate, arithmetic_name, depth_name};
use super::machine::{LitAt, Machine, subpixel_bits};
use crate::error::{Error, quote};
use crate::options::{Arithmetic, Filter, Interpolation, Lod};
use std::collections::HashMap;

/// The table.
const TABLE: &str = include_str!("chips.csv");
/// The columns before and after the counts of [`Work`].
const WORDS: [&str; 3] = ["target", "kind", "name"];
const BYTES: [&str; 2] = ["flash", "stack"];
const NUMBERS: usize = Work::NAMES.len() + BYTES.len();

/// Its first line.
fn header() -> String {
    [&WORDS[..], &Work::NAMES, &BYTES].concat().join(",")
}

/// The names of each kind, the first that of the kind's base but for `lines`, which has none.
const KINDS: [(&str, bool, &[&str]); 11] = [
    (
        "lines",
        false,
        &[
            "float exact",
            "float plane",
            "float spans:4",
            "float spans:8",
            "float spans:16",
            "float spans:32",
            "float bounded",
            "float affine",
            "fixed spans:4",
            "fixed spans:8",
            "fixed spans:16",
            "fixed spans:32",
            "fixed bounded",
            "fixed affine",
        ],
    ),
    ("float depth", true, &["u16", "f32", "f32-reversed", "u32", "u24", "none"]),
    ("fixed depth", true, &["u16", "f32", "f32-reversed", "u32", "u24", "none"]),
    ("float subpixel", true, &["4", "8"]),
    ("fixed subpixel", true, &["4", "8"]),
    (
        "float filter",
        true,
        &["nearest", "bilinear", "trilinear:pixel", "trilinear:run", "trilinear:triangle"],
    ),
    ("fixed filter", true, &["nearest", "bilinear", "trilinear:run", "trilinear:triangle"]),
    ("float light", true, &["unlit", "lambert"]),
    ("fixed light", true, &["unlit", "lambert", "vertex"]),
    ("fixed mesh", true, &["floats", "integers"]),
    // How far estimates were off, in percent, where other lines have the instructions of a frame.
    ("off", false, &["median", "most", "worst", "baked"]),
];

/// Coefficients in the order of the table's columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Coefficients {
    /// Instructions of a frame, and for each of [`Work`]'s counts.
    counts: [f64; NUMBERS - 2],
    /// Bytes of code.
    pub(super) flash: f64,
    /// Bytes of stack.
    pub(super) stack: f64,
}

impl Coefficients {
    /// The instructions of a frame.
    pub(super) fn frame(&self, work: &Work) -> f64 {
        self.counts.iter().zip(work.counts()).map(|(coefficient, count)| coefficient * count).sum()
    }

    fn plus(&self, other: &Self) -> Self {
        let mut counts = self.counts;
        // Two differences may each be as large as what they are taken from.
        counts.iter_mut().zip(other.counts).for_each(|(sum, other)| *sum = (*sum + other).max(0.0));
        Self { counts, flash: self.flash + other.flash, stack: self.stack + other.stack }
    }
}

/// How far estimates were off on scenes that were also run, in percent: the median, nine tenths of them, the worst.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Off {
    /// The median.
    pub median: f64,
    /// The most of nine tenths of them.
    pub most: f64,
    /// The most of all.
    pub worst: f64,
    /// The most of those of lit meshes of integers.
    pub baked: f64,
}

/// The part of the table that is about one chip.
#[derive(Debug)]
pub(super) struct Chip(HashMap<(&'static str, &'static str), Coefficients>);

impl Chip {
    /// The sum for a way of drawing; `None` if the chip has no such.
    pub(super) fn cost(&self, candidate: Candidate, filter: Filter, lod: Lod) -> Option<Coefficients> {
        let lines = self.get("lines", &lines_name(candidate))?;
        let arithmetic = arithmetic_name(candidate.arithmetic);
        let depth = self.get(&format!("{arithmetic} depth"), depth_name(candidate.depth))?;
        let bits = subpixel_bits(candidate.subpixel).to_string();
        let grid = self.get(&format!("{arithmetic} subpixel"), &bits)?;
        let filter =
            self.get(&format!("{arithmetic} filter"), filter_name(filter, candidate.arithmetic, lod)?)?;
        Some(lines.plus(depth).plus(grid).plus(filter))
    }

    /// The same for what `alberti bake` writes.
    pub(super) fn baked(
        &self,
        candidate: Candidate,
        filter: Filter,
        lod: Lod,
        lit: LitAt,
    ) -> Option<Coefficients> {
        let cost = self.cost(candidate, filter, lod)?;
        let light = match lit {
            LitAt::Nowhere => "unlit",
            LitAt::Pixels => "lambert",
            LitAt::Vertices => "vertex",
        };
        let arithmetic = arithmetic_name(candidate.arithmetic);
        let cost = cost.plus(self.get(&format!("{arithmetic} light"), light)?);
        Some(match candidate.arithmetic {
            Arithmetic::Fixed => cost.plus(self.get("fixed mesh", "integers")?),
            Arithmetic::Float => cost,
        })
    }

    /// How far it is off.
    pub(super) fn off(&self) -> Option<Off> {
        let of = |name| Some(self.get("off", name)?.counts[0]);
        Some(Off { median: of("median")?, most: of("most")?, worst: of("worst")?, baked: of("baked")? })
    }

    fn get(&self, kind: &str, name: &str) -> Option<&Coefficients> {
        let (kind, _, names) = KINDS.iter().find(|(known, ..)| *known == kind)?;
        let name = names.iter().find(|known| **known == name)?;
        self.0.get(&(*kind, *name))
    }
}

/// The name of a candidate's interpolation and arithmetic in the table.
fn lines_name(candidate: Candidate) -> String {
    let arithmetic = arithmetic_name(candidate.arithmetic);
    match candidate.interpolation {
        Interpolation::Bounded(_) => format!("{arithmetic} bounded"),
        interpolation => format!("{arithmetic} {interpolation}"),
    }
}

/// The name of a filter in the table, if it is there. Fixed point finds no level of detail for each pixel.
fn filter_name(filter: Filter, arithmetic: Arithmetic, lod: Lod) -> Option<&'static str> {
    match filter {
        Filter::Nearest => Some("nearest"),
        Filter::Bilinear => Some("bilinear"),
        Filter::Trilinear => Some(match (lod, arithmetic) {
            (Lod::Triangle, _) => "trilinear:triangle",
            (Lod::Run, _) | (_, Arithmetic::Fixed) => "trilinear:run",
            (Lod::Pixel, Arithmetic::Float) => "trilinear:pixel",
        }),
        Filter::Anisotropic(_) => None,
    }
}

/// A chip of the table.
///
/// # Errors
/// A fault of the table.
pub(super) fn chip(machine: Machine) -> Result<Chip, Error> {
    parse(TABLE)?.remove(machine.name()).ok_or_else(|| {
        Error::new(format!("no lines of {}", machine.name()), "coefficients for it").place("chips.csv")
    })
}

/// All chips of a table, complete ones.
fn parse(table: &str) -> Result<HashMap<&'static str, Chip>, Error> {
    const CHIPS: [Machine; 3] = [Machine::M4f, Machine::M0, Machine::Rv32];
    let wrong = |line: usize, found: String, expected: String| {
        Error::new(found, expected).place("chips.csv").line(line)
    };
    let said = |text: &str| quote(text.as_bytes());
    let mut chips: HashMap<&str, Chip> =
        CHIPS.iter().map(|chip| (chip.name(), Chip(HashMap::new()))).collect();
    let mut lines = (1..).zip(table.lines());
    match lines.next() {
        Some((_, line)) if line == header() => {}
        found => {
            let found = found.map_or("nothing".to_owned(), |(_, line)| said(line));
            return Err(wrong(1, found, header()));
        }
    }
    for (number, line) in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let count = WORDS.len() + NUMBERS;
        let (&[target, kind, name], numbers) = fields
            .split_first_chunk()
            .filter(|(_, numbers)| numbers.len() == NUMBERS)
            .ok_or_else(|| wrong(number, format!("{} fields", fields.len()), format!("{count}")))?;
        let chip = chips
            .get_mut(target)
            .ok_or_else(|| wrong(number, said(target), CHIPS.map(Machine::name).join(", ")))?;
        let (kind, has_base, names) = KINDS
            .iter()
            .find(|(known, ..)| *known == kind)
            .ok_or_else(|| wrong(number, said(kind), KINDS.map(|(kind, ..)| kind).join(", ")))?;
        let name = names
            .iter()
            .find(|known| **known == name)
            .ok_or_else(|| wrong(number, said(name), names.join(", ")))?;
        let mut values = [0.0; NUMBERS];
        for ((value, text), column) in
            values.iter_mut().zip(numbers).zip(Work::NAMES.into_iter().chain(BYTES))
        {
            let parsed = text.parse().ok().filter(|value: &f64| value.is_finite());
            *value = parsed.ok_or_else(|| wrong(number, said(text), format!("a number for {column}")))?;
        }
        if *has_base && *name == names[0] && values != [0.0; NUMBERS] {
            let found = format!("a difference of {name} from itself");
            return Err(wrong(number, found, "zeros".to_owned()));
        }
        let [counts @ .., flash, stack] = values;
        if chip.0.insert((*kind, *name), Coefficients { counts, flash, stack }).is_some() {
            return Err(wrong(number, format!("{target},{kind},{name} again"), "each line once".to_owned()));
        }
    }
    let end = table.lines().count() + 1;
    for target in CHIPS.map(Machine::name) {
        let Some(chip) = chips.get_mut(target) else { continue };
        for (kind, has_base, names) in KINDS {
            if has_base {
                chip.0.entry((kind, names[0])).or_default();
            }
            if let Some(name) = names.iter().find(|name| !chip.0.contains_key(&(kind, **name))) {
                return Err(wrong(end, "the end".to_owned(), format!("a line {target},{kind},{name}")));
            }
        }
    }
    Ok(chips)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advise::OfKind;
    use crate::options::{DepthFormat, SpanLength, Subpixel};

    #[test]
    fn the_table_is_complete() {
        let chips = parse(TABLE).expect("a table without faults");
        for chip in [Machine::M4f, Machine::M0, Machine::Rv32] {
            assert!(
                chips[chip.name()].cost(Candidate::MOST_PRECISE, Filter::Trilinear, Lod::Pixel).is_some()
            );
        }
    }

    const ZEROS: &str = "0,0,0,0,0,0,0,0,0,0,0,0,0,0";

    /// A table in which a line's frame is its number, and its other numbers are 0 but for some.
    fn numbered() -> Vec<String> {
        let mut lines = vec![header()];
        for target in ["m4f", "m0", "rv32"] {
            for (kind, has_base, names) in KINDS {
                for name in &names[usize::from(has_base)..] {
                    lines.push(format!("{target},{kind},{name},{},{ZEROS},0,0", lines.len()));
                }
            }
        }
        lines
    }

    #[test]
    fn costs_are_sums_of_products() {
        let mut lines = numbered();
        let at = |lines: &[String], start: &str| {
            lines.iter().position(|line| line.starts_with(start)).expect("a line")
        };
        let line = at(&lines, "m0,lines,fixed spans:8,");
        lines[line] = "m0,lines,fixed spans:8,1,2,3,5,9,8,6,7,11,17,0.5,0.25,0.125,13,19,1000,300".to_owned();
        let line = at(&lines, "m0,fixed depth,none,");
        lines[line] = "m0,fixed depth,none,0.5,0,0,0,0,0,0,0,0,-2,0,0,0,0,-1,-100,-8".to_owned();
        let line = at(&lines, "m0,fixed filter,bilinear,");
        lines[line] = "m0,fixed filter,bilinear,0,0,0,0,0,0,0,0,0,0,0,0,0,0,40,500,16".to_owned();
        let chips = parse(&lines.join("\n")).expect("a table");
        let candidate = Candidate {
            interpolation: Interpolation::Spans(SpanLength::Eight),
            arithmetic: Arithmetic::Fixed,
            subpixel: Subpixel::Sub4,
            depth: DepthFormat::None,
        };
        let cost = chips["m0"].cost(candidate, Filter::Bilinear, Lod::Pixel).expect("a cost");
        assert_eq!((cost.flash, cost.stack), (1400.0, 308.0));
        let work = Work {
            vertices: 10.0,
            submitted: 20.0,
            clipped: 1.0,
            small: OfKind { triangles: 2.0, rows: 4.0, samples: 8.0 },
            narrow: OfKind { triangles: 15.0, rows: 100.0, samples: 1000.0 },
            wide: OfKind { triangles: 16.0, rows: 32.0, samples: 64.0 },
            runs: 200.0,
            written: 600.0,
        };
        let differences = |more: f64| Coefficients { counts: [more; NUMBERS - 2], flash: 0.0, stack: 0.0 };
        assert_eq!(differences(1.0).plus(&differences(-2.0)).frame(&work), 0.0);
        // 1.5 + 20 + 60 + 5 + (18 + 32 + 48) + (105 + 1100 + 15000) + (8 + 8 + 8) + 2600 + 58 · 600
        assert_eq!(cost.frame(&work), 53_813.5);
        // A vertex of integers takes 2 less and a lit one 7 more, a lit pixel 100: 10 · 5 + 600 · 100.
        let line = at(&lines, "m0,fixed mesh,integers,");
        lines[line] = "m0,fixed mesh,integers,0,-2,0,0,0,0,0,0,0,0,0,0,0,0,0,300,20".to_owned();
        let line = at(&lines, "m0,fixed light,lambert,");
        lines[line] = "m0,fixed light,lambert,0,7,0,0,0,0,0,0,0,0,0,0,0,0,100,700,60".to_owned();
        // A vertex that is lit itself takes 5 more, and a pixel 3.
        let line = at(&lines, "m0,fixed light,vertex,");
        lines[line] = "m0,fixed light,vertex,0,5,0,0,0,0,0,0,0,0,0,0,0,0,3,0,0".to_owned();
        let chips = parse(&lines.join("\n")).expect("a table");
        let of = |lit| chips["m0"].baked(candidate, Filter::Bilinear, Lod::Pixel, lit).expect("a cost");
        let [unlit, lit, at_vertices] = [LitAt::Nowhere, LitAt::Pixels, LitAt::Vertices].map(of);
        assert_eq!((unlit.frame(&work), lit.frame(&work)), (53_813.5 - 20.0, 53_813.5 + 60_050.0));
        assert_eq!(at_vertices.frame(&work), 53_813.5 + 30.0 + 1800.0);
        assert_eq!((lit.flash, lit.stack), (2400.0, 388.0));
        let anisotropic = Filter::Anisotropic(crate::options::Probes::Two);
        assert!(chips["m0"].cost(candidate, anisotropic, Lod::Pixel).is_none());
    }

    #[test]
    fn faults_are_told_with_their_line() {
        let spoiled = |change: &dyn Fn(&mut Vec<String>)| {
            let mut lines = numbered();
            change(&mut lines);
            parse(&lines.join("\n")).expect_err("a fault").to_string()
        };
        type Change = fn(&mut Vec<String>);
        let cases: [(Change, &str); 10] = [
            (|lines| lines[0] = "target".into(), "chips.csv:1: found \"target\""),
            (|lines| lines[3] = "m4f,lines,float spans:4,1".into(), "4 fields, expected 20"),
            (|lines| lines[3] = lines[3].replace("m4f", "m7"), "\"m7\", expected m4f, m0, rv32"),
            (|lines| lines[3] = lines[3].replace("lines", "line"), "\"line\", expected lines, float depth"),
            (
                |lines| lines[3] = lines[3].replace("spans:4", "spans:5"),
                "\"float spans:5\", expected float exact",
            ),
            (|lines| lines[3] = lines[3].replace(",3,0", ",x,0"), "\"x\", expected a number for frame"),
            (|lines| lines[3] = lines[3].replace(",3,0", ",inf,0"), "a number for frame"),
            (|lines| lines[3] = lines[2].clone(), "m4f,lines,float plane again"),
            (
                |lines| lines[3] = format!("m4f,fixed depth,u16,1,{ZEROS},0,0"),
                "a difference of u16 from itself",
            ),
            (|lines| _ = lines.remove(3), "expected a line m4f,lines,float spans:4"),
        ];
        for (change, part) in cases {
            let message = spoiled(&change);
            assert!(message.contains(part), "{message}");
            assert!(message.starts_with("chips.csv"), "{message}");
        }
    }
}
