//! Films of scene files in which something moves.

use std::fs;

use super::{made, picture, run};
use crate::Folder;

/// Things that move in a scene, with these values written in, if `moves` is false.
fn scene(moves: bool, [ball, light, eye]: [&str; 3]) -> String {
    let animation = |of: &str, key: &str, values: &str, easing: &str| {
        format!(
            "[[animation]]\nof = \"{of}\"\nkey = \"{key}\"\ntimes = [0, 1]\nvalues = {values}\neasing = \"{easing}\"\n"
        )
    };
    let moving = [
        animation("ball", "position", "[[-1, 0.5, 0], [1, 0.5, 0]]", "linear"),
        animation("lamp", "color", "[\"ff0000\", \"00ff80\"]", "ease-in"),
        animation("camera", "eye", "[[0, 2, 5], [4, 2, 5]]", "ease-out"),
    ];
    let moving = if moves { moving.concat() } else { String::new() };
    format!(
        "size = [40, 30]\n[camera]\neye = {eye}\ntarget = [0, 0.5, 0]\n[render]\nsamples = 1\n\
         [[object]]\nsurface = \"plane\"\nsize = [4, 4]\nmaterial = \"glass\"\n\
         [[object]]\nname = \"ball\"\nsurface = \"sphere\"\nradius = 0.5\nposition = {ball}\n\
         [material.glass]\nblend = \"constant:0.5\"\n\
         [[light]]\nname = \"lamp\"\nkind = \"point\"\nposition = [0, 3, 2]\ncolor = \"{light}\"\n{moving}"
    )
}

/// Each frame of what moves is the picture of a file with the values of its time.
#[test]
fn frames_of_what_moves_are_files_with_the_values_of_their_times() {
    // After half of the time a quarter of the way is gone by easing in, and three quarters by easing out.
    let start = ["[-1, 0.5, 0]", "ff0000", "[0, 2, 5]"];
    let half = ["[0, 0.5, 0]", "bf4020", "[3, 2, 5]"];
    let files =
        [("a.toml", scene(true, start)), ("0.toml", scene(false, start)), ("5.toml", scene(false, half))];
    let folder = Folder::with(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
    let told = made(&folder, "turntable a.toml --fps 10 -o %d.png");
    assert!(told.starts_with("a.toml: 4098 triangles, 11 frames of 40x30"), "{told}");
    for (number, time) in [(0, "0"), (5, "0.5")] {
        made(&folder, &format!("render {number}.toml -o still.png"));
        made(&folder, &format!("render a.toml --time {time} -o moved.png"));
        let [frame, still, moved] = ["0.png", "still.png", "moved.png"]
            .map(|name| picture(&folder, &name.replace('0', &number.to_string())));
        assert!(frame == still && moved == still, "{number}");
    }
    assert!(picture(&folder, "0.png") != picture(&folder, "5.png"));
    // On a ground, and with a turn of the camera beside it.
    made(&folder, "turntable a.toml --fps 10 --ground --degrees 90 -o g%d.png --threads 3");
    made(&folder, "turntable a.toml --fps 10 --ground --degrees 90 -o h%d.png --threads 1");
    made(&folder, "render a.toml --ground -o moved.png");
    assert!(picture(&folder, "g0.png") == picture(&folder, "moved.png"));
    assert!(picture(&folder, "g7.png") == picture(&folder, "h7.png"));
    assert!(picture(&folder, "g7.png") != picture(&folder, "7.png"));
    let failed = run(&folder, "turntable a.toml --time 1 -o x.gif");
    assert!(
        failed.stderr.starts_with("error: --time: found an option that `turntable` has not"),
        "{failed:?}"
    );
    let failed = run(&folder, "render a.toml --time -1 -o x.png");
    assert!(failed.stderr.starts_with("error: --time: found -1, expected a number of seconds"), "{failed:?}");
    let failed = run(&folder, "render 0.toml --time 1 -o x.png");
    assert!(
        failed.stderr.starts_with("error: --time: found it for a scene in which nothing moves"),
        "{failed:?}"
    );
}

/// A camera that nobody has placed does not follow what moves, and turns at the same distance.
#[test]
fn a_camera_stays_where_it_was_at_the_start() {
    let moving = |of: &str, key: &str, values: &str| {
        format!("[[animation]]\nof = \"{of}\"\nkey = \"{key}\"\ntimes = [0, 1]\nvalues = {values}\n")
    };
    let objects = "size = [40, 30]\n[[object]]\nname = \"ball\"\nsurface = \"sphere\"\n";
    let rises = moving("ball", "position", "[[0, 0, 0], [0, 0.5, 0]]");
    let a = format!("{objects}{rises}");
    let b = format!("{a}{}", moving("camera", "azimuth", "[0, 90]"));
    let folder = Folder::with(&[("a.toml", a.as_bytes()), ("b.toml", b.as_bytes())]);
    let eye = |line: &str| {
        let told = made(&folder, &format!("{line} --far 100 -o x.png"));
        let eye = told.split("--eye ").nth(1).and_then(|rest| rest.split(' ').next()).expect("an eye");
        eye.split(',').map(|number| number.parse().expect("a number")).collect::<Vec<f64>>()
    };
    assert_eq!(eye("render a.toml"), eye("render a.toml --time 0.001"));
    let [start, end] = [eye("render b.toml"), eye("render b.toml --time 1")];
    for (found, expected) in end.iter().zip([start[2], start[1], -start[0]]) {
        // Around what is seen, which is not quite the middle.
        assert!((found - expected).abs() < 0.03, "{start:?} {end:?}");
    }
}

/// A ball that rises from a table, and leaves it to one side: seen all the time, and its ground stays where it is.
#[test]
fn all_of_a_motion_is_framed_and_stands_on_one_ground() {
    let text = "background = \"ffffff\"\nsize = [60, 60]\n[render]\nsamples = 1\n\
        [[object]]\nname = \"ball\"\nsurface = \"sphere\"\nmaterial = \"red\"\n[material.red]\ncolor = \"ff0000\"\n\
        [[animation]]\nof = \"ball\"\nkey = \"position\"\ntimes = [0, 1, 2]\n\
        values = [[0, 1, 0], [6, 5, 0], [0, 1, 0]]\n";
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let open = |name: &str| image::open(folder.path(name)).expect("a picture").into_rgb8();
    let red = |name: &str| {
        let picture = open(name);
        let is_red = |x: u32, y: u32| {
            let [r, g, _] = picture.get_pixel(x, y).0;
            r > 40 && g < r / 3
        };
        let edge = (0..60).any(|k| is_red(k, 0) || is_red(k, 59) || is_red(0, k) || is_red(59, k));
        let count = (0..3600).filter(|k| is_red(k % 60, k / 60)).count();
        (count, edge)
    };
    // Frames without a rate are all of the motion.
    for turn in ["0", "360"] {
        made(&folder, &format!("turntable a.toml --frames 8 --degrees {turn} -o %d.png"));
        for frame in 0..8 {
            let (count, edge) = red(&format!("{frame}.png"));
            assert!(count > 20 && !edge, "{turn} degrees, frame {frame}: {count} pixels");
        }
    }
    made(&folder, "turntable a.toml --frames 8 --ground -o g%d.png");
    made(&folder, "render a.toml --time 1 --ground -o moved.png");
    assert!(open("g4.png") == open("moved.png"));
    // The darkest place of the ground, which has no hue.
    let darkest = |name: &str| open(name).pixels().map(|p| p.0).filter(|[r, g, b]| r == g && g == b).min();
    // It stands on the ground at first, and is far above it half-way.
    assert!(
        darkest("g0.png") < Some([190; 3]) && darkest("g4.png") > Some([240; 3]),
        "{:?} {:?}",
        darkest("g0.png"),
        darkest("g4.png")
    );
    // A motion that does not end as it began is shown up to its end.
    let text = text.replace("[0, 1, 2]", "[0, 1, 1.6]").replace("[0, 1, 0]]", "[1, 1, 0]]");
    fs::write(folder.path("b.toml"), text).expect("a file");
    made(&folder, "turntable b.toml --frames 5 -o e%d.png");
    made(&folder, "render b.toml --time 1.6 -o moved.png");
    assert!(open("e4.png") == open("moved.png") && open("e3.png") != open("moved.png"));
    // With a rate, they are the first ones.
    made(&folder, "turntable a.toml --frames 2 --fps 1 -o f%d.png");
    made(&folder, "render a.toml --time 1 -o moved.png");
    assert!(open("f1.png") == open("moved.png"));
}

/// Options that say nothing of a motion, and a motion that is too long.
#[test]
fn films_of_motions_tell_what_is_amiss() {
    let text = "size = [40, 30]\n[[object]]\nsurface = \"sphere\"\n[camera]\neye = [0, 2, 5]\n\
        [[animation]]\nof = \"camera\"\nkey = \"eye\"\ntimes = [0, 4000]\nvalues = [[0, 2, 5], [0, -3, 5]]\n";
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let failed = run(&folder, "turntable a.toml -o a.gif");
    assert_eq!(failed.status, Some(2));
    assert!(failed.stderr.contains("--fps: found a motion of more than 100000 frames"), "{failed:?}");
    let said = run(&folder, "turntable a.toml --frames 6 --ground --axis 1,0,0 -o a%d.png").stderr;
    assert!(said.contains("--axis: found it for a camera that does not turn"), "{said}");
    assert!(said.contains("--ground: found 2 of 6 frames from below the model's lowest point"), "{said}");
    assert_eq!(said.lines().count(), 2, "{said}");
}

/// A camera that goes round by its angles has all in view at all times, as far away at each of them.
#[test]
fn cameras_that_go_round_have_all_in_view() {
    let text = "size = [40, 30]\nbackground = \"000000\"\n[render]\nsamples = 1\nshading = \"unlit\"\n\
        [[object]]\nsurface = \"cylinder\"\nradius = 0.5\nheight = 8\nrotation = [90, 0, 0]\n\
        [[animation]]\nof = \"camera\"\nkey = \"azimuth\"\ntimes = [0, 4]\nvalues = [0, 360]\n";
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    made(&folder, "turntable a.toml --frames 12 -o %02d.png");
    let mut widest = 0;
    for frame in 0..12 {
        let image = image::open(folder.path(&format!("{frame:02}.png"))).expect("a frame").to_rgb8();
        let seen: Vec<_> = image.enumerate_pixels().filter(|(.., p)| p.0 != [0; 3]).collect();
        assert!(seen.len() > 30, "{frame}");
        assert!(seen.iter().all(|(x, y, _)| (1..39).contains(x) && (1..29).contains(y)), "{frame}");
        let columns = seen.iter().map(|(x, ..)| *x);
        widest = widest.max(columns.clone().max().unwrap() - columns.min().unwrap());
    }
    // From the side it fills the picture.
    assert!(widest > 28, "{widest}");
    made(&folder, "render a.toml --time 1 -o moved.png");
    assert!(picture(&folder, "moved.png") == picture(&folder, "03.png"));
}

/// Angles that end whole turns after their start are where they were: the last frame would be the first again.
#[test]
fn whole_turns_go_round() {
    let turning = |of: &str, key: &str, values: &str| {
        format!(
            "size = [40, 30]\n[render]\nsamples = 1\n[[object]]\nname = \"b\"\nsurface = \"torus\"\n\
             [[animation]]\nof = \"{of}\"\nkey = \"{key}\"\ntimes = [0, 1]\nvalues = {values}\n"
        )
    };
    for (of, key, values, frames) in [
        ("b", "rotation", "[[0, 0, 0], [0, 360, 0]]", 10),
        ("b", "rotation", "[[10, 0, 0], [-710, 0, 360]]", 10),
        ("b", "rotation", "[[0, 0, 0], [0, 359, 0]]", 11),
        ("camera", "azimuth", "[-180, 180]", 10),
        ("camera", "roll", "[0, 90]", 11),
        // A place is another one.
        ("b", "position", "[[0, 0, 0], [18, 0, 0]]", 11),
    ] {
        let folder = Folder::with(&[("a.toml", turning(of, key, values).as_bytes())]);
        made(&folder, "turntable a.toml --fps 10 -o %d.png");
        let count = folder.names().iter().filter(|name| name.ends_with(".png")).count();
        assert_eq!(count, frames, "{key} {values}");
    }
}

/// What an animation clashes with names its key; light that an animation alone gives has a place.
#[test]
fn keys_of_animations_are_named() {
    let ball = "size = [40, 30]\n[[object]]\nsurface = \"sphere\"\n";
    let text = format!(
        "{ball}[camera]\neye = [0, 1, 4]\n[[animation]]\nof = \"camera\"\nkey = \"azimuth\"\ntimes = [0, 1]\n\
         values = [0, 90]\n"
    );
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let failed = run(&folder, "render a.toml --time 1");
    let told = "error: a.toml:10: animation.values: found camera.azimuth with camera.eye, which says where";
    assert!(failed.stderr.starts_with(told), "{failed:?}");
    let text = format!(
        "{ball}[[animation]]\nof = \"ambient\"\nkey = \"intensity\"\ntimes = [0, 1]\nvalues = [0, 1]\n"
    );
    let folder = Folder::with(&[
        ("a.toml", text.as_bytes()),
        ("b.toml", format!("background = \"sky.png\"\n{ball}").as_bytes()),
    ]);
    let told = "warning: a.toml:8: animation.values: found ambient.intensity without a [[light]]";
    let said = run(&folder, "render a.toml").stderr;
    assert!(said.starts_with(told), "{said}");
    let failed = run(&folder, "render b.toml").stderr;
    assert!(
        failed.starts_with("error: b.toml:1: background: found no such file for the image \"sky.png\""),
        "{failed}"
    );
}

/// Pictures of a longer film after the last are told, and the time of shadows is their own.
#[test]
fn pictures_of_longer_films_are_told() {
    let folder = Folder::with(&[("a.toml", scene(true, ["[-1, 0.5, 0]", "ff0000", "[0, 2, 5]"]).as_bytes())]);
    made(&folder, "turntable a.toml --frames 4 -o %d.png");
    let shorter = run(&folder, "turntable a.toml --frames 3 --ground -o %d.png");
    assert!(shorter.stderr.starts_with("warning: 3.png: found a picture of a longer film"), "{shorter:?}");
    assert!(shorter.stdout.contains(" shadow "), "{shorter:?}");
    let all = run(&folder, "turntable a.toml --frames 4 -o %d.png");
    assert!(all.stderr.is_empty() && !all.stdout.contains(" shadow "), "{all:?}");
}

/// Values that no camera has are told before anything is drawn, where they stand, with their time.
#[test]
fn values_of_cameras_are_looked_at_first() {
    let text = |key: &str, values: &str| {
        format!(
            "[[object]]\nsurface = \"sphere\"\n[camera]\neye = [0, 0, 3]\ntarget = [0, 0, 0]\nfov = 40\n\
             [[animation]]\nof = \"camera\"\nkey = \"{key}\"\ntimes = [0, 2]\nvalues = {values}\n"
        )
    };
    for (key, values, told) in [
        (
            "fov",
            "[40, 190]",
            "found 190 degrees, expected an angle above 0 and below 180 degrees; that is at 2 s",
        ),
        ("fov", "[40, -5]", "found -5 degrees, expected an angle above 0"),
        ("near", "[0.1, -5]", "found near -5, expected a finite number above 0; that is at 2 s"),
        (
            "up",
            "[[0, 1, 0], [0, 0, 0]]",
            "found the direction 0,0,0, expected one above 0 in length; that is at 2 s",
        ),
        (
            "eye",
            "[[0, 0, 3], [0, 0, 0]]",
            "found the eye and its target both at 0,0,0, expected two points; that is",
        ),
    ] {
        let folder = Folder::with(&[("a.toml", text(key, values).as_bytes())]);
        for line in ["turntable a.toml --fps 10 -o %d.png", "render a.toml", "info a.toml"] {
            let failed = run(&folder, line);
            let place = "error: a.toml:11: animation.values: ";
            assert!(failed.stderr.starts_with(&format!("{place}{told}")), "{line}: {failed:?}");
            assert_eq!(folder.names(), ["a.toml"]);
        }
    }
}

/// Assets are of a moment, and say so.
#[test]
fn assets_of_what_moves_are_told() {
    let start = ["[-1, 0.5, 0]", "ff0000", "[0, 2, 5]"];
    let files = [("a.toml", scene(true, start)), ("0.toml", scene(false, start))];
    let folder = Folder::with(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
    let told = "found a scene in which something moves, expected one that stands; the file has it as it is at the start";
    for (line, name) in [("info a.toml", "a.toml"), ("bake a.toml --out b", "a.toml")] {
        let moving = run(&folder, line);
        assert!(format!("{}{}", moving.stdout, moving.stderr).contains(told), "{moving:?}");
        let later = run(&folder, &format!("{line} --time 0.25"));
        let told = told.replace("the start", "0.25 s");
        assert!(format!("{}{}", later.stdout, later.stderr).contains(&told), "{later:?}");
        let still = run(&folder, &line.replace(name, "0.toml"));
        assert!(!format!("{}{}", still.stdout, still.stderr).contains("moves"), "{still:?}");
    }
}

/// A film in which something moves, by no way at all, about an axis that is not the upward one: its ground is that of
/// the still scene.
#[test]
fn grounds_stay_below_while_the_camera_turns_over() {
    let folder = super::folder();
    let still = "[[object]]\nname = \"a\"\nmodel = \"m.obj\"\n";
    let moving =
        "[[animation]]\nof = \"a\"\nkey = \"position\"\ntimes = [0, 1]\nvalues = [[0, 0, 0], [0, 0, 0]]\n";
    fs::write(folder.path("still.toml"), still).expect("a scene");
    fs::write(folder.path("moving.toml"), format!("{still}{moving}")).expect("a scene");
    let line = "--eye 2,1.5,3 --target 0,0.5,0 --size 40x30 --frames 6 --degrees 360 --axis z --ground";
    let said = ["still", "moving"].map(|name| {
        let said = run(&folder, &format!("turntable {name}.toml {line} -o {name}-%d.png")).stderr;
        said.lines().filter(|line| line.contains("below")).map(str::to_owned).collect::<Vec<_>>()
    });
    assert!(!said[0].is_empty() && said[0] == said[1], "{said:?}");
    for frame in 0..6 {
        let [a, b] = ["still", "moving"].map(|name| picture(&folder, &format!("{name}-{frame}.png")));
        assert!(a == b, "{frame}");
    }
}
