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
        let arithmetic = match arithmetic {
            Arithmetic::Float => "float",
            Arithmetic::Fixed => "fixed",
        };
        format!(
            "--interpolation {interpolation} --arithmetic {arithmetic} --depth {} --subpixel {}",
            depth_name(self.depth),
            subpixel_bits(self.subpixel),
        )
    }

    /// The lines of a program for a machine that select it. `side` is that of the largest texture.
    #[must_use]
    pub fn rust(self, machine: Machine, side: u16) -> String {
        let lines = match self.interpolation {
            Interpolation::Exact => "Exact".to_owned(),
            Interpolation::Plane => "Planes".to_owned(),
            Interpolation::Spans(SpanLength::Sixteen) => "Spans16".to_owned(),
            Interpolation::Spans(length) => {
                format!("Lines::spans({}).expect(\"a power of two\")", length.columns())
            }
            Interpolation::Bounded(texels) => format!("Lines::bounded_texels({texels:?}, {side})"),
            Interpolation::Affine => "Affine".to_owned(),
        };
        let interpolation = match self.arithmetic {
            Arithmetic::Float => lines,
            Arithmetic::Fixed => format!("FixedPoint({lines})"),
        };
        let depth = match self.depth {
            DepthFormat::F32 => "F32",
            DepthFormat::F32Reversed => "F32Reversed",
            DepthFormat::U32 => "D32",
            DepthFormat::U24 => "D24",
            DepthFormat::U16 => "D16",
            DepthFormat::None => "NoDepth",
        };
        let (color, draw) = if machine.is_chip() {
            ("Rgb565Le", "slots(&mut slots).draw_by(One, &mut target)")
        } else {
            ("Rgba8888", "draw(&mut target)")
        };
        let bits = subpixel_bits(self.subpixel);
        format!(
            "let mut target = Target::new({color}, {depth}, width, height, &mut color, &mut depth)?;\n\
             Pass::new(&view, &mesh, stage).interpolation({interpolation}).subpixel(Sub{bits}).{draw};\n",
        )
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
        for (machine, own) in [
            (Machine::Host, ["Target::new(Rgba8888, D16", ".draw(&mut target)"]),
            (Machine::M0, ["Target::new(Rgb565Le, D16", ".draw_by(One, &mut target)"]),
        ] {
            let rust = candidate.rust(machine, 256);
            for part in own.into_iter().chain(["FixedPoint(Lines::bounded_texels(0.25, 256))", "Sub4"]) {
                assert!(rust.contains(part), "{rust}");
            }
        }
    }
}
