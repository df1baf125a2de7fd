//! The kept cases of each target, and simple ones, run again: what a fuzzer has found stays found.

use alberti_hostile::{TARGETS, cases};
use std::fs;
use std::path::Path;

/// Bytes that are in no corpus: none, the same ones, and all.
fn simple() -> impl Iterator<Item = Vec<u8>> {
    let all: Vec<u8> = (0..=255).collect();
    let turned = all.iter().map(|byte| byte.wrapping_mul(151)).collect();
    [vec![], vec![0; 300], vec![255; 300], all, turned].into_iter()
}

fn replay(names: &[&str]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for (name, body) in TARGETS.iter().filter(|(name, _)| names.contains(name)) {
        let file = folder.join(format!("{name}.hex"));
        let text = fs::read_to_string(&file).expect("each target has a corpus");
        let kept = cases(&text).expect("lines of digits");
        assert!(kept.len() >= 8, "{name} has {} cases", kept.len());
        kept.into_iter().chain(simple()).for_each(|case| body(&case));
    }
}

#[test]
fn libraries_keep_their_invariants() {
    replay(&[
        "numbers",
        "view",
        "clip",
        "triangle",
        "pipeline",
        "sampler",
        "mipmap",
        "surface",
        "displacement",
        "baked",
    ]);
}

/// One after the other, since they have one folder.
#[test]
fn the_application_keeps_its_invariants() {
    replay(&["obj", "mtl", "scene", "image", "options"]);
}

#[test]
fn all_targets_are_replayed() {
    assert_eq!(TARGETS.len(), 10 + 5);
    assert!(
        cases("00ff\n\n0a\n") == Ok(vec![vec![0, 255], vec![10]])
            && cases("0\n").is_err()
            && cases("0g\n").is_err()
    );
}
