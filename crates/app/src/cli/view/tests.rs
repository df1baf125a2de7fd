//! Tests of what a window shows: the picture of the command line that it prints.

use std::fs;
use std::path::Path;

use std::ffi::OsStr;

use super::keys::of_letter;
use super::*;
use crate::scene::Image;

const SIZE: [u32; 2] = [96, 72];

const MODEL: &str = "mtllib m.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.5 0\nvt 0 0\nvt 1 0\nvt 0.5 1\n\
    usemtl a\nf 1/1 5/3 2/2\nf 2/1 5/3 3/2\nf 3/1 5/3 4/2\nusemtl b\nf 4/1 5/3 1/2\nf 1/1 2/2 3/3\nf 1/1 3/2 4/3\n";

const LIBRARY: &str = "newmtl a\nKd 0.8 0.4 0.2\nmap_Kd t.png\nnewmtl b\nKd 0.2 0.5 0.9\nd 0.6\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("m.obj"), MODEL).expect("a model");
    fs::write(folder.path().join("m.mtl"), LIBRARY).expect("a library");
    let texels =
        image::RgbImage::from_fn(8, 8, |x, y| image::Rgb([if (x + y) % 2 == 0 { 250 } else { 30 }; 3]));
    texels.save(folder.path().join("t.png")).expect("a texture");
    folder
}

fn viewer(folder: &Path, options: &str) -> Viewer {
    let model = folder.join("m.obj").into_os_string();
    let words: Vec<_> = std::iter::once(model).chain(options.split_whitespace().map(Into::into)).collect();
    Viewer::new(&words, SIZE).expect("a scene")
}

/// The picture of `render` with the words of a viewer.
fn rendered(viewer: &Viewer, folder: &Path) -> Image {
    let path = folder.join("p.png");
    let mut words = viewer.all_words();
    words.extend(["-q".into(), "-o".into(), path.clone().into_os_string()]);
    let status = crate::cli::run::attempt(words).expect("a picture");
    assert_eq!(status, 0);
    let image = image::open(path).expect("a picture").to_rgba8();
    let texels = image.pixels().map(|pixel| pixel.0).collect();
    Image { width: image.width(), height: image.height(), texels }
}

fn act(viewer: &mut Viewer, keys: &str) {
    for key in keys.chars() {
        let action = match key {
            '<' => Action::Turn([-20.0, 0.0]),
            '>' => Action::Turn([35.0, 10.0]),
            '^' => Action::Pan([0.1, -0.2]),
            'P' => panic!("a picture is written by the tests"),
            key => of_letter(&key.to_string(), false).expect("a key"),
        };
        viewer.act(action).unwrap_or_else(|error| panic!("{keys}: {error}"));
    }
}

#[test]
fn the_window_shows_what_its_words_draw() {
    let folder = folder();
    for (options, keys) in [
        ("", ""),
        ("", "<"),
        ("", ">+^"),
        ("", "iiiii"),
        ("--ground", ">"),
        ("", ">g+++i>"),
        ("--near 0.2 --far 60", ">+"),
        ("", "o+>^"),
        ("--samples 1", "gg<"),
        ("--zoom 1.5 --roll 20", ">-"),
        ("", "5>"),
        ("", "o>"),
        ("--projection parallel --view-height 3", "+"),
        ("--background red..blue", "f<ff"),
        ("--azimuth 70", "v"),
        ("", "vvvv>"),
        ("", "sl>"),
        ("", "ct>0"),
        ("--ground", "++^"),
        ("--ground --projection parallel", "+^"),
    ] {
        let mut viewer = viewer(folder.path(), options);
        act(&mut viewer, keys);
        let shown = viewer.picture(false).expect("a picture").image;
        let words = viewer.all_words();
        assert!(shown == rendered(&viewer, folder.path()), "{options} {keys}: {words:?}");
        // Keys' choices are said once.
        let projections = words.iter().filter(|word| word.to_string_lossy().starts_with("--projection"));
        assert!(options.contains("projection") || projections.count() <= 1, "{words:?}");
    }
}

#[test]
fn keys_and_the_mouse_change_the_picture() {
    let folder = folder();
    let mut viewer = viewer(folder.path(), "--samples 1");
    let picture = |viewer: &Viewer| viewer.picture(false).expect("a picture").image;
    let first = picture(&viewer);
    // From what the command line has on, no press is without effect; faces that are flat are alike in three shadings.
    for keys in ["<", "+", "^", "1", "v", "i", "ssss", "a", "o", "f", "l", "g"] {
        act(&mut viewer, keys);
        assert!(picture(&viewer) != first, "{keys}");
        viewer = super::tests::viewer(folder.path(), "--samples 1");
    }
    // Planes follow the camera, also when an option has been chosen.
    act(&mut viewer, "<i");
    let before = viewer.camera();
    act(&mut viewer, "++");
    assert!(viewer.camera().near < 0.9 * before.near);
    act(&mut viewer, "iiii0");
    // The first camera comes back, and so do the first options.
    act(&mut viewer, ">^0");
    assert!(picture(&viewer) == first);
    act(&mut viewer, "iiiii");
    assert!(viewer.options().is_empty() && picture(&viewer) == first);
}

#[test]
fn sizes_and_files_are_followed() {
    let folder = folder();
    let mut viewer = viewer(folder.path(), "");
    act(&mut viewer, ">");
    viewer.resize([120, 60]).expect("a size");
    let shown = viewer.picture(false).expect("a picture").image;
    assert_eq!([shown.width, shown.height], [120, 60]);
    assert!(shown == rendered(&viewer, folder.path()));
    // A draft has the same size.
    let draft = viewer.picture(true).expect("a picture").image;
    assert!(draft != shown && draft.texels.len() == shown.texels.len());

    fs::write(folder.path().join("m.mtl"), LIBRARY.replace("map_Kd t.png", "")).expect("a library");
    viewer.reload().expect("a model");
    let changed = viewer.picture(false).expect("a picture").image;
    assert!(changed != shown && changed == rendered(&viewer, folder.path()));
    // A broken file is told, and the picture stays.
    fs::write(folder.path().join("m.obj"), "f 1 2 9\n").expect("a model");
    let told = viewer.reload().expect_err("a broken model").to_string();
    assert!(told.contains("m.obj:1"), "{told}");
    assert!(viewer.picture(false).expect("a picture").image == changed);

    fs::write(folder.path().join("n.obj"), MODEL.replace("1.5", "2.5")).expect("a model");
    viewer.open(folder.path().join("n.obj")).expect("a model");
    assert!(viewer.name().ends_with("n.obj"));
    assert!(viewer.picture(false).expect("a picture").image == rendered(&viewer, folder.path()));
    let told = viewer.open(folder.path().join("none.obj")).expect_err("no model").to_string();
    assert!(told.contains("none.obj") && viewer.name().ends_with("n.obj"), "{told}");
}

#[test]
fn options_that_cannot_be_are_told_and_change_nothing() {
    let folder = folder();
    let mut viewer = viewer(folder.path(), "--projection perspective --near 0.5 --far 90");
    act(&mut viewer, "<+");
    let before = viewer.picture(false).expect("a picture").image;
    fs::write(folder.path().join("m.obj"), "f 1 2 9\n").expect("a model");
    // Files are read when the scene is staged again.
    let moved = viewer.moved;
    viewer.words.push("--samples=3".into());
    for key in ["1", "0", "i", "o"] {
        let told = viewer.act(of_letter(key, false).expect("a key")).expect_err("no such samples");
        assert!(told.to_string().contains("samples"), "{told}");
        assert!(viewer.options().is_empty() && viewer.moved == moved, "{key}");
    }
    viewer.words.pop();
    assert!(viewer.picture(false).expect("a picture").image == before);
}

/// Keys go over options of the command line that say the same, and pass over values that others exclude.
#[test]
fn keys_go_over_the_command_line() {
    let folder = folder();
    for (options, key, other) in [
        ("--eye 1,2,4 --near 1 --far 9", "3", "--view right"),
        ("--eye=1,2,4", "7", "--view iso"),
        ("--azimuth 20 --elevation 5", "7", "--view iso"),
        ("--azimuth 20 --elevation=5", "5", "--view top"),
        ("--view left --elevation 5", "1", "--view front"),
        ("--eye 1,2,4 --target 0,1,0", "2", "--target 0,1,0 --view back"),
        ("--near 0.25", "2", "--near 0.25 --view back"),
        ("--projection parallel --view-height 3", "o", ""),
        ("--arithmetic fixed --interpolation affine", "i", "--arithmetic fixed --interpolation spans:16"),
    ] {
        let mut first = viewer(folder.path(), options);
        let begun = first.picture(false).expect("a picture").image;
        for keys in [key, &format!(">{key}")] {
            act(&mut first, keys);
            let shown = first.picture(false).expect("a picture").image;
            if keys == key || key != "o" && key != "i" {
                let same = viewer(folder.path(), other).picture(false).expect("a picture").image;
                assert!(shown == same, "{options} {keys}");
            }
            assert!(shown == rendered(&first, folder.path()), "{options} {keys}");
            first = viewer(folder.path(), options);
        }
        act(&mut first, key);
        act(&mut first, if key == "o" { "o" } else { "0" });
        if key != "i" {
            assert!(first.picture(false).expect("a picture").image == begun, "{options}");
        }
    }
}

/// Pictures that are kept replace none, unless `-o` names their file, and their command makes them again.
#[test]
fn kept_pictures_have_their_command() {
    let folder = folder();
    let mut viewer = viewer(folder.path(), "--samples 1 -q");
    act(&mut viewer, ">gs");
    let shown = viewer.picture(false).expect("a picture").image;
    let output = folder.path().join("kept one.png");
    viewer.output = Some(output.clone());
    viewer.words.extend(["-o".into(), output.clone().into_os_string()]);
    assert_eq!(viewer.keep().expect("a picture"), output);
    let kept = image::open(&output).expect("a picture").to_rgba8();
    assert!(kept.pixels().map(|pixel| pixel.0).eq(shown.texels.iter().copied()));
    let words = viewer.all_words();
    let command = words.iter().map(|word| typed(word)).collect::<Vec<_>>().join(" ");
    for part in ["--ground=true", "--shading=gouraud", "--size 96x72", "--eye ", "'", "kept one.png'"] {
        assert!(command.contains(part), "{part}: {command}");
    }
    // A shell has the same words of it.
    #[cfg(unix)]
    {
        let script = format!("printf '%s\\n' {command}");
        let told = std::process::Command::new("sh").args(["-c", &script]).output().expect("a shell").stdout;
        let words: Vec<_> = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
        assert_eq!(String::from_utf8_lossy(&told).lines().collect::<Vec<_>>(), words);
    }
    assert_eq!(typed(OsStr::new("a'b c")), r"'a'\''b c'");
    let stem = folder.path().join("m").to_string_lossy().into_owned();
    for k in 1..4 {
        let name = folder.path().join(format!("m-{k}.png"));
        assert_eq!(unused(&stem, "png"), name);
        fs::write(name, "").expect("a file");
    }
}

/// A motion goes on as its command line draws it, and round; a camera that has been moved stays.
#[test]
fn a_motion_is_that_of_its_frames() {
    let folder = folder();
    let scene = "[[object]]\nname = \"a\"\nmodel = \"m.obj\"\n[[object]]\nsurface = \"sphere\"\nposition = [1, 1, 1]\n\
        [[animation]]\nof = \"a\"\nkey = \"position\"\ntimes = [0, 2]\nvalues = [[0, 0, 0], [1, 0, 1]]\n\
        [[animation]]\nof = \"camera\"\nkey = \"azimuth\"\ntimes = [0, 1]\nvalues = [0, 40]\n";
    fs::write(folder.path().join("s.toml"), scene).expect("a scene");
    let words = |options: &str| -> Vec<OsString> {
        let scene = folder.path().join("s.toml").into_os_string();
        std::iter::once(scene).chain(options.split_whitespace().map(Into::into)).collect()
    };
    let picture = |viewer: &Viewer| viewer.picture(false).expect("a picture").image;
    for (options, keys) in [("", ""), ("--ground", ""), ("--time 0.5", ""), ("", ">+")] {
        let mut viewer = Viewer::new(&words(options), SIZE).expect("a scene");
        act(&mut viewer, keys);
        let first = picture(&viewer);
        let before = viewer.camera();
        let [end, start] = viewer.motion().expect("a motion");
        viewer.advance(0.25, false).expect("a frame");
        assert_eq!((end, viewer.motion()), (2.0, Some([2.0, start + 0.25])));
        let next = picture(&viewer);
        assert!(next != first && next == rendered(&viewer, folder.path()), "{options} {keys}");
        assert_eq!(viewer.camera().eye == before.eye, !keys.is_empty());
        // Other keys keep the time, and all of it is gone through.
        act(&mut viewer, "i");
        assert_eq!(viewer.motion(), Some([2.0, start + 0.25]));
        assert!(picture(&viewer) == rendered(&viewer, folder.path()));
        act(&mut viewer, "iiii");
        viewer.advance(1.75, false).expect("a frame");
        assert_eq!(viewer.motion(), Some([2.0, start]));
        assert!(picture(&viewer) == first, "{options} {keys}");
        // In haste a ground has half as many cells, until the motion stands.
        let has_ground = options == "--ground";
        viewer.advance(0.5, true).expect("a frame");
        assert_eq!(viewer.scene.is_coarse, has_ground);
        let (hasty, whole) = (picture(&viewer), rendered(&viewer, folder.path()));
        let off = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
        let most = hasty.texels.iter().zip(&whole.texels).filter_map(off).max();
        assert!((hasty != whole) == has_ground && most < Some(40), "{most:?}");
        viewer.stage_at_time(false).expect("a frame");
        assert!(!viewer.scene.is_coarse && picture(&viewer) == whole);
    }
    let mut viewer = viewer(folder.path(), "");
    let told = viewer.advance(0.1, false).expect_err("nothing moves").to_string();
    assert!(viewer.motion().is_none() && told.contains("[[animation]]"), "{told}");
}

/// Without a texture there are no levels of detail to show.
#[test]
fn what_cannot_be_shown_is_passed_over() {
    let folder = folder();
    fs::write(folder.path().join("m.mtl"), "newmtl a\n").expect("a library");
    let mut viewer = viewer(folder.path(), "");
    for expected in ["error", "depth-step"] {
        act(&mut viewer, "v");
        assert_eq!(viewer.options(), [format!("--show={expected}")]);
        viewer.picture(false).expect("a picture");
    }
}

/// Pixels that differ from those of planes far before and far behind all there is.
fn cut_away(viewer: &Viewer, folder: &Path) -> usize {
    let shown = viewer.picture(false).expect("a picture").image;
    assert!(shown == rendered(viewer, folder), "{:?}", viewer.all_words());
    let mut other = viewer.all_words();
    other.drain(..2);
    other.extend(["--near=0.05", "--far=400", "--depth=f32-reversed"].map(OsString::from));
    let whole = Viewer::new(&other, SIZE).expect("a scene").picture(false).expect("a picture").image;
    let is_far = |(a, b): &(&[u8; 4], &[u8; 4])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 24);
    shown.texels.iter().zip(&whole.texels).filter(is_far).count()
}

/// The planes of a camera that has been moved are around what there is now: later, in another file, with a ground.
#[test]
fn planes_follow_what_is_seen() {
    let folder = folder();
    let scene = |text: &str| {
        let path = folder.path().join("s.toml");
        fs::write(&path, text).expect("a scene");
        path.into_os_string()
    };
    let moving = "[camera]\nazimuth = 20\n[[object]]\nname = \"a\"\nsurface = \"sphere\"\n[[object]]\nname = \"b\"\n\
        surface = \"sphere\"\nradius = 0.3\nposition = [0, 0, 1.5]\n[[animation]]\nof = \"b\"\nkey = \"position\"\n\
        times = [0, 1]\nvalues = [[1.4, 0, 0], [1, 0, 12]]\n";
    let mut later = Viewer::new(&[scene(moving)], SIZE).expect("a scene");
    act(&mut later, "<<");
    for _ in 0..6 {
        later.advance(0.1, false).expect("a frame");
        assert_eq!(cut_away(&later, folder.path()), 0, "{:?}", later.camera());
    }
    let own = "[camera]\neye = [6, 4, 8]\nnear = 5\nfar = 20\n[[object]]\nmodel = \"m.obj\"\n";
    let mut nearer = Viewer::new(&[scene(own)], SIZE).expect("a scene");
    act(&mut nearer, "++++++");
    assert_eq!(cut_away(&nearer, folder.path()), 0, "{:?}", nearer.camera());
    act(&mut nearer, "0");
    assert_eq!((nearer.camera().near, nearer.camera().far), (5.0, 20.0));

    let mut grounded = viewer(folder.path(), "--elevation 5");
    act(&mut grounded, "<--g");
    assert!(cut_away(&grounded, folder.path()) < 3, "{:?}", grounded.camera());

    let mut edited = viewer(folder.path(), "");
    act(&mut edited, "<---");
    fs::write(folder.path().join("m.obj"), MODEL.replace("-1", "-3")).expect("a model");
    edited.reload().expect("a model");
    assert_eq!(cut_away(&edited, folder.path()), 0, "{:?}", edited.camera());
}

/// The projection of a camera that has been moved changes, with as much in view at its target, and changes back.
#[test]
fn projections_change_after_a_move() {
    let folder = folder();
    for options in ["", "--projection parallel", "--projection parallel --view-height 2"] {
        let mut viewer = viewer(folder.path(), options);
        act(&mut viewer, ">");
        let (before, orbit) = (viewer.picture(false).expect("a picture").image, viewer.orbit());
        let height = |orbit: Orbit| match orbit.projection {
            Projection::Parallel { height } => height,
            Projection::Perspective => camera::window_height(&orbit.camera),
        };
        act(&mut viewer, "o");
        let other = viewer.orbit();
        assert_ne!(
            matches!(orbit.projection, Projection::Parallel { .. }),
            matches!(other.projection, Projection::Parallel { .. })
        );
        assert!((height(orbit) / height(other) - 1.0).abs() < 1e-5, "{orbit:?} {other:?}");
        let shown = viewer.picture(false).expect("a picture").image;
        assert!(shown != before && shown == rendered(&viewer, folder.path()), "{options}");
        act(&mut viewer, "+<");
        assert!(viewer.picture(false).expect("a picture").image == rendered(&viewer, folder.path()));
        act(&mut viewer, "o");
        assert_eq!(
            matches!(orbit.projection, Projection::Parallel { .. }),
            matches!(viewer.orbit().projection, Projection::Parallel { .. })
        );
    }
}

/// A shadow is looked for once, and again when something else may throw it.
#[test]
fn shadows_are_kept() {
    let folder = folder();
    let mut viewer = viewer(folder.path(), "--ground");
    let is_kept = |viewer: &mut Viewer, keys: &str| {
        let before = viewer.shadows.clone();
        act(viewer, keys);
        let same = before.iter().zip(&viewer.shadows).all(|(a, b)| Arc::ptr_eq(a, b));
        assert!(viewer.picture(false).expect("a picture").image == rendered(viewer, folder.path()), "{keys}");
        same && !before.is_empty() && before.len() == viewer.shadows.len()
    };
    for keys in ["i", "f", "s", "a", "l", "o", ">", "3", "gg"] {
        assert!(is_kept(&mut viewer, keys), "{keys}");
    }
    assert!(!is_kept(&mut viewer, "ddd"));
    fs::write(folder.path().join("m.obj"), MODEL.replace("1.5", "2.5")).expect("a model");
    let before = viewer.shadows.clone();
    viewer.reload().expect("a model");
    assert!(!Arc::ptr_eq(&before[0], &viewer.shadows[0]));
    assert!(viewer.picture(false).expect("a picture").image == rendered(&viewer, folder.path()));
}

/// A model that a moved camera does not see any more is told, with the key that looks at it.
#[test]
fn empty_pictures_say_so() {
    let folder = folder();
    let mut viewer = viewer(folder.path(), "");
    act(&mut viewer, ">");
    assert_eq!(viewer.picture(false).expect("a picture").legend, [""; 0]);
    let away = MODEL.replace("\nv ", "\nv 500");
    fs::write(folder.path().join("m.obj"), away.replace("500-", "50")).expect("a model");
    viewer.reload().expect("a model");
    let legend = viewer.picture(false).expect("a picture").legend;
    assert_eq!(legend, ["nothing is in the picture; 0 looks at all of it"]);
    act(&mut viewer, "0");
    assert_eq!(viewer.picture(false).expect("a picture").legend, [""; 0]);
}

/// Options of keys are let go where an edited scene cannot have them. A file that is dropped has pictures of its own.
#[test]
fn scenes_let_go_of_what_they_cannot_have() {
    let folder = folder();
    let path = folder.path().join("s.toml");
    let still = "[[object]]\nname = \"a\"\nmodel = \"m.obj\"\n";
    let moving = format!(
        "{still}[[animation]]\nof = \"a\"\nkey = \"position\"\ntimes = [0, 2]\nvalues = [[0, 0, 0], [1, 0, 1]]\n"
    );
    fs::write(&path, moving).expect("a scene");
    let mut viewer = Viewer::new(&[path.clone().into_os_string()], SIZE).expect("a scene");
    act(&mut viewer, ".i");
    let broken = still.replace("m.obj", "none.obj");
    fs::write(&path, broken).expect("a scene");
    let told = viewer.reload().expect_err("no such model").to_string();
    assert!(told.contains("none.obj") && viewer.motion().is_some_and(|[_, time]| time > 0.0), "{told}");
    fs::write(&path, still).expect("a scene");
    viewer.reload().expect("a scene in which nothing moves");
    assert!(viewer.motion().is_none() && viewer.options() == ["--interpolation=plane"]);
    assert!(viewer.picture(false).expect("a picture").image == rendered(&viewer, folder.path()));

    let mut viewer = self::viewer(folder.path(), "-o out.png --size 70x50 --show error");
    viewer.output = Some("out.png".into());
    assert_eq!(viewer.first.iter().flatten().filter(|value| *value == "error").count(), 1);
    viewer.open(folder.path().join("m.obj")).expect("a model");
    assert_eq!(viewer.output, None);
    // The size is said once.
    let words = viewer.all_words();
    assert_eq!(words.iter().filter(|word| *word == "--size").count(), 1, "{words:?}");
}
