//! Films of things that stand, or move over a floor: planes and shadows are those of stills.

use super::{made, picture, run};
use crate::Folder;

/// Balls on a floor around which the eye is as well, from near which on nothing else is seen.
fn scene(floor: u32, [eye, turn, strength]: [&str; 3], moves: &str) -> String {
    format!(
        "size = [40, 30]\n[camera]\neye = {eye}\ntarget = [0, 0, 0]\n[render]\nsamples = 1\n\
         [[object]]\nsurface = \"plane\"\nsize = [{floor}, {floor}]\n\
         [[object]]\nsurface = \"sphere\"\nradius = 0.5\nposition = [-1, 0.5, 0]\n\
         [[object]]\nname = \"b\"\nsurface = \"sphere\"\nradius = 0.5\nposition = [1, 0.5, 0]\nrotation = {turn}\n\
         [[light]]\nname = \"lamp\"\nkind = \"directional\"\ndirection = [-1, -2, -1]\nintensity = {strength}\n{moves}"
    )
}

/// Motion of one key, up to half of which it is as in a still: the camera and the light leave the shadow as it is, and
/// a ball that turns has that of a ball.
#[test]
fn shadows_and_planes_of_what_moves_are_those_of_stills() {
    let first = ["[0, 3, 7]", "[0, 0, 0]", "1"];
    for (of, key, values, half, most) in [
        ("camera", "eye", "[[0, 3, 7], [4, 1, 7]]", ["[2, 2, 7]", first[1], first[2]], 0),
        ("lamp", "intensity", "[1, 0]", [first[0], first[1], "0.5"], 0),
        ("b", "rotation", "[[0, 0, 0], [0, 360, 0]]", [first[0], "[0, 180, 0]", first[2]], 4),
    ] {
        let moves =
            format!("[[animation]]\nof = \"{of}\"\nkey = \"{key}\"\ntimes = [0, 1]\nvalues = {values}\n");
        for floor in [12, 20_000] {
            let files =
                [("moves.toml", scene(floor, first, &moves)), ("stands.toml", scene(floor, half, ""))];
            let folder = Folder::with(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
            made(&folder, "turntable moves.toml --ground --frames 3 -o %d.png");
            made(&folder, "render stands.toml --ground -o still.png");
            made(&folder, "render stands.toml -o bare.png");
            let [frame, still, bare] = ["1.png", "still.png", "bare.png"].map(|name| picture(&folder, name));
            let off = |a: &[u8], b: &[u8]| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
            assert!(off(&frame, &still) <= most, "{key} {floor}: {}", off(&frame, &still));
            assert!(off(&still, &bare) > 60, "{key} {floor}: {}", off(&still, &bare));
        }
    }
}

/// A ball that rolls along has its shadow below it all the way, and a ground stands still below what falls.
#[test]
fn shadows_follow_what_moves() {
    let roll = "[[animation]]\nof = \"b\"\nkey = \"position\"\ntimes = [0, 1]\nvalues = [[1, 0.5, 0], [5, 0.5, 0]]\n";
    let text = scene(30, ["[0, 9, 0.1]", "[0, 0, 0]", "1"], roll);
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    made(&folder, "turntable a.toml --frames 2 -o bare%d.png");
    // By one thread, which has the shadow of the first frame when it draws the second.
    made(&folder, "turntable a.toml --frames 2 --ground --threads 1 -o %d.png");
    for (frame, [from, to]) in [(0, [20, 28]), (1, [32, 40])] {
        let [bare, shadow] = ["bare", ""].map(|name| picture(&folder, &format!("{name}{frame}.png")));
        // In the row through the middle, beside the still ball at the left.
        let row = |picture: &[u8]| picture[15 * 120..16 * 120].to_vec();
        let darker = row(&bare)
            .iter()
            .zip(row(&shadow))
            .map(|(a, b)| i32::from(*a) - i32::from(b))
            .collect::<Vec<_>>();
        let most =
            |range: std::ops::Range<usize>| darker[3 * range.start..3 * range.end].iter().max().copied();
        assert!(most(from..to) > Some(25), "{frame}: {darker:?}");
    }
}

/// Nothing in a picture is told beside other warnings, and of frames that have nothing their number is.
#[test]
fn empty_frames_are_told() {
    let text = "size = [40, 30]\n[camera]\neye = [0, 0, 6]\ntarget = [0, 0, 0]\nnear = 100\nfar = 200\n\
        [[object]]\nsurface = \"sphere\"\n[material.x]\ncolor = \"red\"\n";
    let away = text.replace("near = 100\nfar = 200\n", "");
    let away = away
        + "[[animation]]\nof = \"camera\"\nkey = \"eye\"\ntimes = [0, 3]\nvalues = [[0, 0, 6], [0, 900, 6]]\n\
        easing = \"hold\"\n[[animation]]\nof = \"camera\"\nkey = \"target\"\ntimes = [0, 3]\nvalues = [[0, 0, 0], [0, 950, 6]]\n\
        easing = \"hold\"\n";
    let folder = Folder::with(&[("a.toml", text.as_bytes()), ("b.toml", away.as_bytes())]);
    for (line, told) in [
        ("render a.toml -o a.png", "found nothing of the model in the picture"),
        ("turntable a.toml --frames 3 -o a%d.png", "found nothing of the model in 3 of 3 frames"),
        ("turntable b.toml --fps 1 -o b%d.png", "found nothing of the model in 1 of 4 frames"),
    ] {
        let run = run(&folder, line);
        assert_eq!(run.status, Some(0), "{run:?}");
        assert!(run.stderr.contains(told) && run.stderr.contains("a material of no object"), "{run:?}");
    }
}
