//! A family in short: for each policy its cost and its errors over all scenes, and which of them nothing beats.

use crate::errors::Texels;
use crate::family::{Axis, Family};
use crate::table::Line;

/// A policy over all scenes of its family.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// The policy.
    pub policy: String,
    /// The mean of its instructions as multiples of the reference's, where they were counted.
    pub instructions: Option<f64>,
    /// The least, the median and the greatest of its times as multiples of the reference's.
    pub time: Option<[f64; 3]>,
    /// Errors of texture coordinates in texels: the geometric mean of the scenes, of the largest but for one in a
    /// thousand; and the largest of any scene.
    pub texels: Option<[f64; 2]>,
    /// The same of bytes of the picture.
    pub bytes: [u8; 2],
    /// The worst PSNR of any scene, in dB.
    pub psnr: f64,
    /// The mean FLIP of the scenes, and the worst.
    pub flip: [f64; 2],
    /// Whether no other policy of the family is at once as cheap and as right, and better in one of the two.
    pub front: bool,
}

impl Summary {
    /// The cost that plots and fronts go by: instructions, or else the time.
    pub fn cost(&self) -> f64 {
        self.instructions.or(self.time.map(|[_, median, _]| median)).unwrap_or(1.0)
    }

    /// The error that they go by.
    pub fn error(&self, axis: Axis) -> f64 {
        match axis {
            Axis::Texels => self.texels.map_or(0.0, |[mean, _]| mean),
            Axis::Flip => self.flip[0],
        }
    }
}

/// The summaries of a family, in the order of its policies.
pub fn summaries(family: &Family, lines: &[Line]) -> Vec<Summary> {
    let lines: Vec<&Line> = lines.iter().filter(|line| line.family == family.name).collect();
    let mut policies: Vec<&str> = vec![];
    for line in &lines {
        if !policies.contains(&line.policy.as_str()) {
            policies.push(&line.policy);
        }
    }
    let mut all: Vec<Summary> = policies
        .into_iter()
        .map(|policy| {
            let own: Vec<&Line> = lines.iter().copied().filter(|line| line.policy == policy).collect();
            summary(policy, &own, &lines)
        })
        .collect();
    let points: Vec<[f64; 2]> = all.iter().map(|s| [s.cost(), s.error(family.axis)]).collect();
    for (summary, front) in all.iter_mut().zip(front(&points)) {
        summary.front = front;
    }
    all
}

fn summary(policy: &str, own: &[&Line], family: &[&Line]) -> Summary {
    let reference = |line: &Line| family.iter().find(|other| other.reference && other.scene == line.scene);
    let ratios: Option<Vec<f64>> = own
        .iter()
        .map(|line| {
            let reference = reference(line)?.instructions?;
            #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
            let ratio = line.instructions? as f64 / reference as f64;
            Some(ratio)
        })
        .collect();
    let mut times: Vec<f64> = own.iter().filter_map(|line| Some(line.time?.ratio[1])).collect();
    times.sort_by(f64::total_cmp);
    let time = (!times.is_empty()).then(|| [times[0], median(&times), times[times.len() - 1]]);
    let worst = |of: &dyn Fn(&Line) -> f64| own.iter().map(|line| of(line)).fold(0.0, f64::max);
    let texels: Option<Vec<Texels>> = own.iter().map(|line| line.errors.texels).collect();
    let bytes = |of: fn(&Line) -> u8| own.iter().map(|line| of(line)).max().unwrap_or_default();
    #[expect(clippy::cast_precision_loss, reason = "few scenes")]
    let count = own.len() as f64;
    Summary {
        policy: policy.to_owned(),
        instructions: ratios.map(|ratios| geometric_mean(ratios.into_iter())),
        time,
        texels: texels.map(|texels| {
            let largest = texels.iter().map(|texels| texels.largest).fold(0.0, f64::max);
            [geometric_mean(texels.iter().map(|texels| texels.most.max(LEAST))), largest]
        }),
        bytes: [bytes(|line| line.errors.picture.largest), bytes(|line| line.errors.picture.most)],
        psnr: own.iter().map(|line| line.errors.picture.psnr()).fold(f64::INFINITY, f64::min),
        flip: [
            own.iter().map(|line| line.errors.picture.flip).sum::<f64>() / count,
            worst(&|line| line.errors.picture.flip),
        ],
        front: false,
    }
}

/// Texels that count as no error.
const LEAST: f64 = 1e-6;

fn geometric_mean(numbers: impl ExactSizeIterator<Item = f64>) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "few scenes")]
    let count = numbers.len() as f64;
    (numbers.map(f64::ln).sum::<f64>() / count).exp()
}

/// The median of sorted numbers, of an even count the mean of the two in the middle.
fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { f64::midpoint(sorted[middle - 1], sorted[middle]) }
}

/// Of points (cost, error), which are on the Pareto front. What differs by less than a hundredth is the same.
fn front(points: &[[f64; 2]]) -> Vec<bool> {
    let beats = |a: &[f64; 2], b: &[f64; 2]| {
        let less = [0, 1].map(|axis| a[axis] < b[axis] * 0.99);
        let as_good = [0, 1].map(|axis| a[axis] <= b[axis] * 1.01);
        (as_good[0] && less[1]) || (less[0] && as_good[1])
    };
    points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points =
            [[1.0, 0.1], [2.0, 0.01], [2.0, 0.05], [3.0, 0.01], [0.5, 0.9], [0.5, 1.0], [1.005, 0.1]];
        assert_eq!(front(&points), [true, true, false, false, true, false, true]);
        assert_eq!(front(&[[1.0, 0.100], [0.9, 0.1005]]), [false, true]);
    }

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!((median(&[1.0, 2.0, 9.0]), median(&[1.0, 3.0]), median(&[4.0])), (2.0, 2.0, 4.0));
    }
}
