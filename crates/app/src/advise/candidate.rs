//! Policies that can be advised, as options of the command and as lines of a program.

use super::machine::{Machine, subpixel_bits};
use crate::options::{Arithmetic, DepthFormat, Interpolation, Policies, RenderOptions, SpanLength, Subpixel};

/// A choice of what an approximation may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// From vertices to pixels.
    pub interpolation: Interpolation,
    /// By which arithmetic.
    pub arithmetic: Arithmetic,
    /// The vertices' grid.
    pub subpixel: Subpixel,
    /// The depth buffer.
    pub depth: DepthFormat,
}

/// Depth formats beside the most precise.
const DEPTHS: [DepthFormat; 5] =
    [DepthFormat::F32, DepthFormat::U32, DepthFormat::U24, DepthFormat::U16, DepthFormat::None];

impl Candidate {
    /// Those of the right picture.
    pub const MOST_PRECISE: Self = Self {
        interpolation: Interpolation::Exact,
        arithmetic: Arithmetic::Float,
        subpixel: Subpixel::Sub8,
        depth: DepthFormat::F32Reversed,
    };

    /// A picture's options with these policies.
    #[must_use]
    pub fn options(self, options: &RenderOptions) -> RenderOptions {
        let Self { interpolation, arithmetic, subpixel, depth } = self;
        let policies = Policies { interpolation, arithmetic, subpixel, ..options.policies };
        RenderOptions { policies, depth, ..*options }
    }

    /// The same by its interpolation, its depth buffer and its grid alone.
    pub(super) fn parts(self) -> [Self; 3] {
        let Self { interpolation, arithmetic, subpixel, depth } = self;
        let most_precise = Self::MOST_PRECISE;
        [
            Self { interpolation, arithmetic, ..most_precise },
            Self { depth, ..most_precise },
            Self { subpixel, ..most_precise },
        ]
    }

    /// Whether it is the most precise but perhaps for the interpolation.
    pub(super) fn is_interpolation(self) -> bool {
        let Self { interpolation, arithmetic, .. } = self;
        self == Self { interpolation, arithmetic, ..Self::MOST_PRECISE }
    }

    /// The same but for the depth buffer.
    pub(super) fn is_depth(self) -> bool {
        self == Self { depth: self.depth, ..Self::MOST_PRECISE }
    }

    /// The same but for the grid.
    pub(super) fn is_grid(self) -> bool {
        self == Self { subpixel: self.subpixel, ..Self::MOST_PRECISE }
    }

    /// The options of the command that select it.
    #[must_use]
    pub fn command_line(self) -> String {
        let Self { interpolation, arithmetic, .. } = self;
        format!(
            "--interpolation {interpolation} --arithmetic {} --depth {} --subpixel {}",
            arithmetic_name(arithmetic),
            depth_name(self.depth),
            subpixel_bits(self.subpixel),
        )
    }

    /// The lines of a program for a machine that select it. `side` is that of the largest texture.
    #[must_use]
    pub fn rust(self, machine: Machine, side: u16) -> String {
        let (kind, lines) = match self.interpolation {
            Interpolation::Exact => ("Exact", "Exact".to_owned()),
            Interpolation::Plane => ("Planes", "Planes".to_owned()),
            Interpolation::Spans(SpanLength::Sixteen) => ("Spans16", "Spans16".to_owned()),
            Interpolation::Spans(length) => {
                ("Lines", format!("Lines::spans({}).expect(\"a power of two\")", length.columns()))
            }
            Interpolation::Bounded(texels) => ("Lines", format!("Lines::bounded_texels({texels:?}, {side})")),
            Interpolation::Affine => ("Affine", "Affine".to_owned()),
        };
        let depth = match self.depth {
            DepthFormat::F32 => "F32",
            DepthFormat::F32Reversed => "F32Reversed",
            DepthFormat::U32 => "D32",
            DepthFormat::U24 => "D24",
            DepthFormat::U16 => "D16",
            DepthFormat::None => "NoDepth",
        };
        let grid = match self.subpixel {
            Subpixel::Sub4 => "Sub4",
            Subpixel::Sub8 => "Sub8",
        };
        let color = if machine.is_chip() { "Rgb565Le" } else { "Rgba8888" };
        let mut names = vec!["Pass", "Target", kind, depth, grid, color];
        let interpolation = match self.arithmetic {
            Arithmetic::Float => lines,
            Arithmetic::Fixed => {
                names.push("FixedPoint");
                format!("FixedPoint({lines})")
            }
        };
        names.sort_unstable();
        let (lanes, draw) = if machine.is_chip() {
            ("use alberti::lanes::One;\n", ".slots(&mut slots)\n    .draw_by(One, &mut target)")
        } else {
            ("", ".draw(&mut target)")
        };
        format!(
            "{lanes}use alberti::{{{}}};\n\n\
             let mut target = Target::new({color}, {depth}, width, height, &mut color, &mut depth)?;\n\
             Pass::new(&view, &mesh, stage)\n    \
             .interpolation({interpolation})\n    \
             .subpixel({grid})\n    \
             {draw};\n",
            names.join(", "),
        )
    }
}

/// The name of an arithmetic among the options.
pub(super) fn arithmetic_name(arithmetic: Arithmetic) -> &'static str {
    match arithmetic {
        Arithmetic::Float => "float",
        Arithmetic::Fixed => "fixed",
    }
}

/// The name of a depth format among the options.
pub(super) fn depth_name(depth: DepthFormat) -> &'static str {
    match depth {
        DepthFormat::F32 => "f32",
        DepthFormat::F32Reversed => "f32-reversed",
        DepthFormat::U32 => "u32",
        DepthFormat::U24 => "u24",
        DepthFormat::U16 => "u16",
        DepthFormat::None => "none",
    }
}

/// The most precise policies, and each other one alone.
pub(super) fn alone() -> Vec<Candidate> {
    let most_precise = Candidate::MOST_PRECISE;
    let mut all = lines();
    all.extend(DEPTHS.map(|depth| Candidate { depth, ..most_precise }));
    all.push(Candidate { subpixel: Subpixel::Sub4, ..most_precise });
    all
}

/// All combinations.
pub(super) fn combined() -> Vec<Candidate> {
    let all = alone();
    let of = |is: fn(Candidate) -> bool| all.iter().copied().filter(move |candidate| is(*candidate));
    let mut combined = vec![];
    for lines in of(Candidate::is_interpolation) {
        for Candidate { depth, .. } in of(Candidate::is_depth) {
            combined.extend(of(Candidate::is_grid).map(|grid| Candidate {
                depth,
                subpixel: grid.subpixel,
                ..lines
            }));
        }
    }
    combined
}

/// The most precise policies, and each other interpolation and arithmetic alone.
fn lines() -> Vec<Candidate> {
    let most_precise = Candidate::MOST_PRECISE;
    let straight = [
        Interpolation::Spans(SpanLength::Four),
        Interpolation::Spans(SpanLength::Eight),
        Interpolation::Spans(SpanLength::Sixteen),
        Interpolation::Spans(SpanLength::ThirtyTwo),
        Interpolation::Bounded(0.0625),
        Interpolation::Bounded(0.25),
        Interpolation::Bounded(1.0),
        Interpolation::Affine,
    ];
    let by = |interpolation, arithmetic| Candidate { interpolation, arithmetic, ..most_precise };
    let mut all = vec![most_precise, by(Interpolation::Plane, Arithmetic::Float)];
    all.extend(straight.map(|lines| by(lines, Arithmetic::Float)));
    all.extend(straight.map(|lines| by(lines, Arithmetic::Fixed)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti::{FragmentStage, Geometry, Slot, View};

    #[test]
    fn every_policy_is_there_once_and_differs_in_one_thing() {
        let all = alone();
        for (k, candidate) in all.iter().enumerate() {
            assert!(all[..k].iter().all(|other| other != candidate), "{candidate:?}");
            assert!(candidate.is_interpolation() || candidate.is_depth() || candidate.is_grid());
        }
        assert_eq!(all.iter().filter(|candidate| candidate.is_interpolation()).count(), 18);
        assert_eq!(all.iter().filter(|candidate| candidate.is_depth()).count(), 6);
        let combined = combined();
        for (k, candidate) in combined.iter().enumerate() {
            assert!(
                !combined[..k].contains(candidate) && candidate.parts().iter().all(|part| all.contains(part))
            );
        }
        assert_eq!(combined.len(), 18 * 6 * 2);
    }

    #[test]
    fn options_and_lines_say_the_same() {
        let candidate = Candidate {
            interpolation: Interpolation::Bounded(0.25),
            arithmetic: Arithmetic::Fixed,
            subpixel: Subpixel::Sub4,
            depth: DepthFormat::U16,
        };
        assert_eq!(
            candidate.command_line(),
            "--interpolation bounded:0.25 --arithmetic fixed --depth u16 --subpixel 4"
        );
        let rust = candidate.rust(Machine::Host, 256);
        for part in ["Target::new(Rgba8888, D16", "FixedPoint(Lines::bounded_texels(0.25, 256))", "Sub4"] {
            assert!(rust.contains(part), "{rust}");
        }
    }

    /// A program that the compiler has read, and its text.
    macro_rules! compiled {
        (($($name:ident: $type:ty),*) $($line:tt)*) => {{
            #[expect(dead_code, unused_mut, reason = "it is compiled, not run")]
            #[allow(clippy::too_many_arguments, reason = "some programs have more than others")]
            fn program($(mut $name: $type),*) -> Result<(), alberti::TargetError> {
                $($line)*
                Ok(())
            }
            stringify!($($line)*)
        }};
    }

    /// Policies of one kind that the compiler has read, as text.
    macro_rules! policies {
        ($is:path: $($policy:expr),* $(,)?) => {{
            fn check(_: impl $is) {}
            $(check($policy);)*
            [$(stringify!($policy)),*].map(plain)
        }};
    }

    /// A text without spaces, and without the comma that closes a list.
    fn plain(text: &str) -> String {
        text.replace(char::is_whitespace, "").replace(",}", "}")
    }

    #[test]
    fn programs_are_compiled() {
        let host = compiled! {
            (width: u32, height: u32, color: [u32; 16], depth: [f32; 16], view: View,
             mesh: impl Geometry<Varying = ()>, stage: impl FragmentStage<()>)
            use alberti::{Exact, F32Reversed, Pass, Rgba8888, Sub8, Target};

            let mut target = Target::new(Rgba8888, F32Reversed, width, height, &mut color, &mut depth)?;
            Pass::new(&view, &mesh, stage)
                .interpolation(Exact)
                .subpixel(Sub8)
                .draw(&mut target);
        };
        let chip = compiled! {
            (width: u32, height: u32, color: [u16; 16], depth: [u16; 16], slots: [Slot<()>; 3], view: View,
             mesh: impl Geometry<Varying = ()>, stage: impl FragmentStage<()>)
            use alberti::lanes::One;
            use alberti::{D16, FixedPoint, Pass, Rgb565Le, Spans16, Sub4, Target};

            let mut target = Target::new(Rgb565Le, D16, width, height, &mut color, &mut depth)?;
            Pass::new(&view, &mesh, stage)
                .interpolation(FixedPoint(Spans16))
                .subpixel(Sub4)
                .slots(&mut slots)
                .draw_by(One, &mut target);
        };
        let small = Candidate {
            interpolation: Interpolation::Spans(SpanLength::Sixteen),
            arithmetic: Arithmetic::Fixed,
            subpixel: Subpixel::Sub4,
            depth: DepthFormat::U16,
        };
        assert_eq!(plain(&Candidate::MOST_PRECISE.rust(Machine::Host, 64)), plain(host));
        assert_eq!(plain(&small.rust(Machine::M4f, 64)), plain(chip));
    }

    #[test]
    fn policies_are_compiled() {
        use alberti::*;
        let interpolations = policies![
            alberti::Interpolation: Exact,
            Planes,
            Spans16,
            Lines::spans(4).expect("a power of two"),
            Lines::spans(8).expect("a power of two"),
            Lines::spans(32).expect("a power of two"),
            Lines::bounded_texels(0.0625, 64),
            Lines::bounded_texels(0.25, 64),
            Lines::bounded_texels(1.0, 64),
            Affine,
        ];
        let depths = policies![alberti::DepthFormat: F32, F32Reversed, D32, D24, D16, NoDepth];
        let grids = policies![Into<alberti::Subpixel>: Sub4, Sub8];
        for candidate in combined() {
            let text = plain(&candidate.rust(Machine::M0, 64));
            let between = |from: &str, to: &str| {
                let (_, rest) = text.split_once(from).expect(from);
                rest.split_once(to).expect(to).0.to_owned()
            };
            let lines = between(".interpolation(", ").subpixel(");
            let inner = lines.strip_prefix("FixedPoint(").and_then(|lines| lines.strip_suffix(')'));
            assert_eq!(inner.is_some(), candidate.arithmetic == Arithmetic::Fixed, "{text}");
            let depth = between("Target::new(Rgb565Le,", ",width");
            let grid = between(".subpixel(", ")");
            let lines = inner.unwrap_or(&lines);
            assert!(interpolations.iter().any(|known| known == lines), "{lines}");
            assert!(depths.contains(&depth) && grids.contains(&grid), "{text}");
            // Each name is imported.
            let imported = between("usealberti::{", "};");
            let imported: Vec<&str> = imported.split(',').collect();
            let kind = lines.split(|c: char| !c.is_alphanumeric()).next().expect("a name");
            for name in [kind, &depth, &grid, "Pass", "Target", "Rgb565Le"] {
                assert!(imported.contains(&name), "{name} is not among {imported:?}");
            }
            assert_eq!(imported.contains(&"FixedPoint"), inner.is_some());
        }
    }
}
