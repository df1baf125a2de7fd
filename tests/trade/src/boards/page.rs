//! The chapter of the page about the boards.

use super::model::{Estimate, float, off};
use super::price::{Price, Special, policy};
use super::scene_file::JUDGED;
use std::fmt::Write as _;

/// The boards, and what stands for people.
const BOARDS: [(&str, &str); 3] =
    [("m4f", "Cortex-M4F"), ("m0", "Cortex-M0, floats in software"), ("rv32", "RV32IMC, floats in software")];

const HEADING: &str = "\
The same scenes of a textured mesh on a display of 320x240 in RGB565, as an emulator counts the instructions of a frame,
without clearing. Every frame has the bits of the host's. Policies are named as the command has them: numbers and
interpolation, with 16 bits of depth, 4 of subpixels and the nearest texel unless a name says otherwise. Nothing is lit
but by `lambert`: light from one direction, on interpolated normals, and by `vertex`: the same light at vertices
(`Lit565`). The mesh is one of floats but for `integers`, as `alberti bake` writes it.
Errors are those of the chapters above, since bits are the same everywhere.

";

const ADVICE: &str = "\
Take `fixed spans:16`: where floats are computed in software it is 7 to 56 times as fast as `float exact`, and on
a Cortex-M4F, which has them, two to five times. `fixed affine` saves up to a third more on large triangles, next to
nothing on a mesh of small ones, and is wrong where triangles are large. Runs of 4 and 8 columns give up the short way
that small triangles have in fixed point, so that meshes cost two to four times as much; a budget, `fixed bounded`, is
for those who must know what is missed. Whoever wants floats takes `float plane`, or on meshes of small triangles
`float exact`. A division takes more than one cycle on most cores, so their number stands beside the instructions; where
there is no instruction for it, it is a call, whose instructions are counted too.

Depths of 16 bits let most small triangles take the short way; those of 24 or 32 bits double or triple the price of a
mesh in fixed point. To do without a depth buffer takes 150 KB less memory and is a little cheaper, unless much is
hidden: then all of that is shaded.

";

/// The chapter.
pub fn chapter(prices: &[Price], estimates: &[Estimate]) -> String {
    let mut text = HEADING.to_owned() + ADVICE;
    filters(&mut text, prices);
    for (board, title) in BOARDS {
        let own: Vec<&Price> = prices.iter().filter(|price| price.board == board).collect();
        if own.is_empty() {
            continue;
        }
        let _ = write!(
            text,
            "### {title}\n\nMillions of instructions a frame; thousands of divisions in the five frames together; bytes \
             of code of a program\nthat draws so and does nothing else, built for size; the most stack. The two buffers \
             take {} KB with 16 bits of depth.\n\n| policy | {} | divisions | code | stack |\n|---|{}---|---|---|\n",
            4 * 320 * 240 / 1024,
            JUDGED.join(" | "),
            "---|".repeat(JUDGED.len())
        );
        let mut names: Vec<&str> = vec![];
        for price in &own {
            if !names.contains(&price.policy.as_str()) {
                names.push(&price.policy);
            }
        }
        for name in names {
            let _ = writeln!(text, "{}", row(name, &own));
        }
        text.push('\n');
    }
    estimated(&mut text, estimates);
    text
}

/// What filters make of a frame's price in fixed point, from the least to the greatest of all boards and scenes.
fn filters(text: &mut String, prices: &[Price]) {
    const USUAL: &str = "fixed spans:16";
    let judged = |price: &&Price| price.scene.is_some_and(|number| number < JUDGED.len());
    let range = |policy: &str, other: &str| {
        let of = |policy: &str, like: &Price| {
            let same = |price: &&Price| (&price.board, price.scene) == (&like.board, like.scene);
            prices.iter().filter(same).find(|price| price.policy == policy).map(|price| float(price.count))
        };
        let usual = prices.iter().filter(|price| price.policy == USUAL).filter(judged);
        let ratios = usual.filter_map(|price| Some(of(policy, price)? / of(other, price)?));
        ratios.fold([f64::INFINITY, 0.0_f64], |[low, high], ratio| [low.min(ratio), high.max(ratio)])
    };
    let [bilinear, trilinear] =
        ["bilinear", "trilinear:run"].map(|filter| range(&format!("{USUAL}, {filter}"), USUAL));
    let triangle = range(&format!("{USUAL}, trilinear:triangle"), &format!("{USUAL}, trilinear:run"));
    if bilinear[1] == 0.0 || triangle[1] == 0.0 {
        return;
    }
    let _ = write!(
        text,
        "A bilinear texture makes a frame in fixed point {:.1} to {:.1} times as dear as the nearest texel, a trilinear \
         one\n{:.1} to {:.1} times. One level of detail for each triangle instead of one for each run makes that {:.2} \
         to {:.2} times\nas dear: the least where triangles are large, where it is also wrong.\n\n",
        bilinear[0], bilinear[1], trilinear[0], trilinear[1], triangle[0], triangle[1],
    );
}

fn row(name: &str, prices: &[&Price]) -> String {
    let own: Vec<&&Price> = prices.iter().filter(|price| price.policy == name).collect();
    let judged = own.iter().filter(|price| price.scene.is_some_and(|number| number < JUDGED.len()));
    let millions = judged.clone().map(|price| format!("{:.2}", float(price.count) / 1e6)).collect::<Vec<_>>();
    let divides: u64 = judged.map(|price| price.divides).sum();
    let code = own.iter().find(|price| price.scene.is_none()).map_or(0, |price| price.count);
    let stack = own.iter().map(|price| price.stack).max().unwrap_or_default();
    format!("| `{name}` | {} | {:.0} | {code} | {stack} |", millions.join(" | "), float(divides) / 1e3)
}

/// How far the estimates of `advise` are from the counts.
fn estimated(text: &mut String, estimates: &[Estimate]) {
    text.push_str(
        "### Estimates\n\n`alberti advise --target` estimates a frame's instructions as a sum: so many for the frame, \
         for each vertex, for\neach triangle, row and sample by the way in which it is rasterized, for each run and \
         each written pixel. The numbers\nwere fitted to small scenes that load one of these each, \
         [calibration.rs](../tests/trade/src/calibration.rs). On the\nfive scenes above, which they were not fitted \
         to, an estimate is off by:\n\n| board | policies | median | 90 % of them | worst | where |\n\
         |---|---|---|---|---|---|\n",
    );
    for (board, title) in BOARDS {
        type Of = fn(Option<Special>) -> bool;
        let kinds: [(&str, Of); 4] = [
            ("interpolation", |special| special.is_none()),
            ("depth, grid, filter", |special| special.is_some_and(|special| !special.is_of_baked())),
            ("light, integers", |special| {
                matches!(special, Some(Special::Light | Special::Mesh | Special::Vertex))
            }),
            ("both, by the sum", |special| special == Some(Special::Baked)),
        ];
        for (kind, is_of) in kinds {
            let own: Vec<&Estimate> = estimates
                .iter()
                .filter(|estimate| estimate.board == board)
                .filter(|estimate| policy(&estimate.policy).is_some_and(|policy| is_of(policy.special)))
                .collect();
            let farthest =
                |a: &&&Estimate, b: &&&Estimate| (a.ratio - 1.0).abs().total_cmp(&(b.ratio - 1.0).abs());
            let Some(place) = own.iter().max_by(farthest) else { continue };
            let [median, most, worst] = off(&own, [50, 90, 100]);
            let _ = writeln!(
                text,
                "| {title} | {kind} | {:.1} % | {:.1} % | {:.0} % | {}, `{}` |",
                median, most, worst, place.scene, place.policy
            );
        }
    }
}
