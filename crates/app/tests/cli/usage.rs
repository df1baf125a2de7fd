//! The command line itself: words that may be left out, help, scripts for shells, and signals.

use std::ffi::OsStr;
use std::fs;
use std::process::Command;

use crate::{Folder, Run, TRIANGLE, alberti};

fn run(folder: &Folder, line: &str) -> Run {
    let words: Vec<_> = line.split_whitespace().collect();
    alberti(&folder.path("."), &[] as &[&OsStr], &words)
}

#[test]
fn a_file_is_rendered_without_the_word() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for line in ["m.obj -s 16x8", "-s 16x8 m.obj", "--scene cube -s 16x8 -j 1"] {
        let made = run(&folder, line);
        assert_eq!((made.status, &made.stderr[..]), (Some(0), ""), "{line}: {made:?}");
        assert_eq!(image::image_dimensions(folder.path("alberti.png")).expect("a picture"), (16, 8));
        fs::remove_file(folder.path("alberti.png")).expect("the picture");
    }
    for (line, told) in [
        (
            "rednr m.obj",
            "error: rednr: found no such command and no file, expected one of the two; did you mean render?",
        ),
        (
            "floor",
            "error: floor: found no such command and no file, expected one of the two; did you mean --scene floor?",
        ),
        ("no.obj", "error: no.obj: found no such file, expected a Wavefront OBJ model"),
        (
            "m.obj other.obj",
            "error: other.obj: found one file too many, expected no other file: a scene file has several models; see --help",
        ),
    ] {
        let made = run(&folder, line);
        assert_eq!((made.status, made.stderr.lines().count()), (Some(2), 1), "{made:?}");
        assert!(made.stderr.starts_with(told), "{made:?}");
    }
}

#[test]
fn the_last_of_repeated_options_wins() {
    let folder = Folder::with(&[("s.toml", b"size = [8, 8]\n[[object]]\nsurface = \"plane\"\n")]);
    for line in ["--size 9x9 -s 16x8", "s.toml -s 9x9 --filter nearest --size 16x8 --filter trilinear -q -q"]
    {
        let made = run(&folder, line);
        assert_eq!((made.status, &made.stderr[..]), (Some(0), ""), "{made:?}");
        assert_eq!(image::image_dimensions(folder.path("alberti.png")).expect("a picture"), (16, 8));
    }
}

#[test]
fn quiet_leaves_errors_and_results() {
    let folder = Folder::with(&[("m.obj", format!("mtllib no.mtl\n{TRIANGLE}").as_bytes())]);
    let made = run(&folder, "m.obj -s 8x8 -q");
    assert_eq!((made.status, &made.stdout[..], &made.stderr[..]), (Some(0), "", ""));
    let made = run(&folder, "m.obj -s 8x8 -q --stats json");
    assert!(made.stdout.starts_with('{') && made.stderr.is_empty(), "{made:?}");
    let made = run(&folder, "m.obj -s 8x8 -q --show overdraw");
    assert_eq!((made.status, &made.stdout[..], &made.stderr[..]), (Some(0), "", ""));
    let made = run(&folder, "-s 8x8 -q -- m.obj");
    assert_eq!((made.status, &made.stdout[..], &made.stderr[..]), (Some(0), "", ""));
    let made = run(&folder, "-- no.obj");
    assert!(
        made.status == Some(2) && made.stderr.starts_with("error: no.obj: found no such file"),
        "{made:?}"
    );
    let made = run(&folder, "no.obj -q");
    assert!(made.status == Some(2) && made.stderr.starts_with("error: "), "{made:?}");
}

#[test]
fn times_are_told_by_work() {
    let folder = Folder::with(&[]);
    let made = run(&folder, "--scene floor -s 64x48 --filter trilinear --stats json");
    let json: serde_json::Value = serde_json::from_str(&made.stdout).expect("JSON");
    for work in ["load", "maps", "mip_maps", "numbers", "shadow", "draw", "count", "encode"] {
        assert!(json["ms"][work].is_f64(), "{json}");
    }
    assert!(json["ms"]["mip_maps"].as_f64() > Some(0.0), "{json}");
    let made = run(&folder, "--scene floor -s 64x48 --filter trilinear");
    assert!(made.stdout.contains(" pixels in alberti.png; load "), "{made:?}");
    let made = run(&folder, "--scene mesh -s 64x48 --ground --aov depth");
    let told = made.stdout.lines().next().unwrap_or_default();
    let places = [" load ", " numbers ", " shadow ", " draw ", " encode "].map(|stage| told.find(stage));
    assert!(places.is_sorted() && places[0].is_some(), "{told}");
}

#[test]
fn mistakes_of_usage_are_one_line() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for (line, told) in [
        ("m.obj --quiet=yes", "error: --quiet: found \"yes\", expected no value; see --help"),
        (
            "m.obj --width 3",
            "error: --width: found no such option, expected one, such as --size WIDTHxHEIGHT; see --help",
        ),
        (
            "m.obj --out a.png",
            "error: --out: found no such option, expected one, such as --output; see --help",
        ),
        ("m.obj --siez 3x3", "error: --siez: found no such option, expected one, such as --size; see --help"),
        (
            "m.obj --scene cube",
            "error: a model: found it beside --scene, expected one of the two; see --help",
        ),
        ("m.obj --eye 1 2 3", "error: 2: found a number on its own, expected an option, or numbers that "),
        (
            "turntable m.obj --duration 2",
            "error: --duration: found no such option, expected one, such as --frames; see --help",
        ),
        (
            "m.obj --ground yes",
            "error: yes: found one file too many, expected no other file or word; a truth is joined to its option, as in \
             --ground=true",
        ),
        ("m.obj -o", "error: --output: found nothing, expected a value; see --help"),
        ("compare a.png", "error: found too few words, expected <B.png> as well; see --help"),
        ("help compare camera", "error: camera: found no such options of `compare`, expected"),
        ("help compare compare", "error: compare: found no such options of `compare`, expected"),
        ("help camra", "error: camra: found no such command or topic, expected one of "),
        (
            "help all camera",
            "error: camera: found one word too many, expected one command or topic; see alberti help all",
        ),
        ("help render camera lens", "error: lens: found one word too many, "),
        (
            "m.obj --ground false",
            "error: false: found one file too many, expected no other file or word; a truth is joined to its option, as in --ground=false",
        ),
        (
            "--stats m.obj",
            "error: --stats: found \"m.obj\", expected one of text, json; the file is taken for the value of --stats: put it first",
        ),
        ("m.obj -s 9x9 --memory 1K", "error: --size: found a picture of 9x9 "),
        ("m.obj --memory 1K", "error: --memory: found a picture of 640x480 "),
        ("m.obj --pixel 3,3", "error: --pixel: found no such option, expected it with alberti explain alone"),
        ("compare - -", "error: -: found standard input for both, expected a file as one of the two"),
        (
            "turntable m.obj -o f%03d.gif",
            "error: f%03d.gif: found a film with a number in its name, expected",
        ),
        ("turntable m.obj -o %d/x.png", "error: %d/x.png: found a number in the name of a folder, expected"),
        ("view m.obj -o m.xyz", "error: m.xyz: found the extension \".xyz\", expected one of .png, "),
        ("advise m.obj --image m.obj", "error: m.obj/pick.png: found a file in the place of its folder, "),
        ("m.obj out.PNG", "error: out.PNG: found one file too many, expected -o out.PNG for the picture"),
        (
            "m.obj n.obj",
            "error: n.obj: found one file too many, expected no other file: a scene file has several",
        ),
        (
            "m.obj --transparent",
            "error: --transparent: found no such option, expected one, such as --background",
        ),
        ("completions fisch", "error: <SHELL>: found \"fisch\", expected one of bash, "),
    ] {
        let made = run(&folder, line);
        assert_eq!((made.status, made.stderr.lines().count()), (Some(2), 1), "{line}: {made:?}");
        assert!(made.stderr.starts_with(told), "{line}: {made:?}");
    }
    assert_eq!(folder.names(), ["m.obj"]);
}

#[test]
fn help_is_short_and_has_the_rest_behind_topics() {
    let folder = Folder::with(&[]);
    let page = |line: &str| {
        let words: Vec<_> = line.split_whitespace().collect();
        let output = Command::new(env!("CARGO_BIN_EXE_alberti"))
            .current_dir(folder.path("."))
            .env("COLUMNS", "80")
            .args(words)
            .output()
            .expect("the command");
        assert_eq!((output.status.code(), &output.stderr[..]), (Some(0), &b""[..]), "{line}");
        String::from_utf8(output.stdout).expect("text")
    };
    for line in [
        "",
        "--help",
        "help",
        "render --help",
        "help render",
        "bake -h",
        "advise -h",
        "explain -h",
        "compare -h",
    ] {
        let page = page(line);
        assert!(page.lines().count() <= 60, "{line}: {} lines", page.lines().count());
        let examples = page.find("Examples:").expect("examples");
        assert!(page.find("--output").is_none_or(|options| examples < options), "{line}");
    }
    assert_eq!(page("m.obj --help"), page("render --help"));
    assert!(page("help camera").contains("--near <A>") && !page("help camera").contains("--wrap"));
    assert_eq!(page("help camera"), page("render --help camera"));
    assert_eq!(page("help Camera"), page("help camera"));
    let lod = run(&folder, "help lod").stderr;
    assert!(lod.ends_with("; --lod is in alberti help precision\n"), "{lod}");
    let all = page("help all");
    for option in
        ["--near", "--wrap", "--lod", "--height-map", "--show", "--projector-fov", "affine: straight"]
    {
        assert!(all.contains(option), "{option}");
    }
    let compared = page("help compare");
    assert!(compared.contains("output     --quiet") && !compared.contains("camera"), "{compared}");
    // All tables that scene files have.
    let scenes = page("help scene-files");
    for part in ["[camera]", "[[object]]", "[material.NAME]", "[[light]]", "[projector]"] {
        assert!(scenes.contains(part), "{part}");
    }
    assert!(!scenes.contains("\n## "));
    assert!(page("--list-scenes").starts_with("hero "));
    assert_eq!(page("--list-scenes").lines().count(), alberti_app::scenes::NAMES.len());
}

/// A device takes the picture itself, and one that is full is an error.
#[cfg(target_os = "linux")]
#[test]
fn devices_and_pipes_take_pictures() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    run(&folder, "m.obj -s 16x8 -o a.png");
    let made = run(&folder, "m.obj -s 16x8 -o /dev/null");
    assert_eq!((made.status, &made.stderr[..]), (Some(0), ""), "{made:?}");
    folder.fails(&["m.obj", "-s", "16x8", "-o", "/dev/full"], &["/dev/full: found that writing fails"]);
    folder.fails(&["m.obj", "-o", "/dev/null", "--aov", "depth"], &["a picture that is no file"]);
    let pipe = format!(
        "mkfifo p && (cat p > b.png & {} m.obj -s 16x8 -o p -q; wait)",
        env!("CARGO_BIN_EXE_alberti")
    );
    let status = Command::new("sh").current_dir(folder.path(".")).args(["-c", &pipe]).status();
    assert!(status.is_ok_and(|status| status.success()));
    let [a, b] = ["a.png", "b.png"].map(|name| fs::read(folder.path(name)).expect("a picture"));
    assert!(!a.is_empty() && a == b);
}

#[test]
fn shells_and_man_have_their_texts() {
    let folder = Folder::with(&[]);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let made = run(&folder, &format!("completions {shell}"));
        assert!(made.status == Some(0) && made.stdout.contains("projector-fov"), "{shell}");
    }
    let script = run(&folder, "completions bash").stdout;
    for suggested in [
        "\"nearest bilinear trilinear anisotropic:4 ",
        " render advise bake compare explain ",
        " scene-files\"",
    ] {
        assert!(script.contains(suggested), "{suggested}");
    }
    let info = script.split_once("__info)").and_then(|(_, rest)| rest.split_once("opts=\"")).expect("a case");
    let offered = info.1.lines().next().unwrap_or_default();
    assert!(offered.contains("--json") && !offered.contains("--output"), "{offered}");
    let page = run(&folder, "man").stdout;
    for part in [
        ".TH alberti 1",
        ".SH ALBERTI ADVISE",
        ".SH EXIT STATUS",
        "\\-\\-heat",
        "Of the options of render it takes \\-\\-quiet.",
        "projector\\-fov",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let (_, synopsis) = page.split_once(".SH SYNOPSIS").expect("uses");
    assert!(synopsis.split(".SH").next().is_some_and(|uses| uses.lines().count() < 12), "{synopsis}");
}

/// At the moment when there is a temporary file, and at others.
#[cfg(unix)]
#[test]
fn signals_leave_no_temporary_file() {
    use std::os::unix::process::ExitStatusExt as _;
    use std::time::{Duration, Instant};
    for (signal, number, delay) in
        [("-TERM", 15, None), ("-INT", 2, None), ("-TERM", 15, Some(1)), ("-INT", 2, Some(30))]
    {
        let folder = Folder::with(&[("out.bmp", b"old")]);
        let mut child = Command::new(env!("CARGO_BIN_EXE_alberti"))
            .current_dir(folder.path("."))
            .args(["--scene", "cube", "-q", "-s", "6000x6000", "-o", "out.bmp"])
            .spawn()
            .expect("the command");
        let start = Instant::now();
        let writes = || {
            let entries = fs::read_dir(folder.path(".")).expect("the folder").flatten();
            let mut temporary = entries.filter(|e| e.file_name().to_string_lossy().starts_with(".alberti-"));
            temporary.any(|entry| entry.metadata().is_ok_and(|metadata| metadata.len() > 0))
        };
        match delay {
            Some(delay) => std::thread::sleep(Duration::from_millis(delay)),
            None => {
                while !writes() && child.try_wait().expect("a child").is_none() {
                    assert!(start.elapsed() < Duration::from_secs(300), "nothing is written");
                }
            }
        }
        let sent = Command::new("kill").args([signal, &child.id().to_string()]).status();
        let status = child.wait().expect("the child");
        assert_eq!(folder.names(), ["out.bmp"], "{sent:?} {status:?}");
        let found = fs::read(folder.path("out.bmp")).expect("the picture");
        if status.success() {
            assert_eq!(found.len(), 54 + 3 * 6000 * 6000);
        } else {
            assert_eq!(status.signal(), Some(number));
            assert!(found == b"old" || found.len() == 54 + 3 * 6000 * 6000);
        }
    }
}

/// Long work shows a bar on a terminal, which is gone at the end, and none elsewhere. `script` has the terminal;
/// without that program there is nothing to see.
#[cfg(target_os = "linux")]
#[test]
fn a_bar_is_shown_on_terminals_alone() {
    let folder = Folder::with(&[]);
    let long = ["--scene", "hero", "-s", "1600x1000", "--samples", "16", "--threads", "1", "-o", "p.bmp"];
    let on_terminal = |more: &str| {
        let command = format!("{} {} {more}", env!("CARGO_BIN_EXE_alberti"), long.join(" "));
        let mut script = Command::new("script");
        script.current_dir(folder.path(".")).args(["-qec", &command, "/dev/null"]);
        let output = script.stdin(std::process::Stdio::null()).output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let Some(shown) = on_terminal("") else { return };
    let (bar, rest) = shown.rsplit_once("\u{1b}[2K").expect("a line that is cleared");
    assert!(bar.contains("drawing "), "{shown}");
    assert!(rest.starts_with("built-in scene hero: ") && !rest.contains("drawing "), "{rest}");
    assert_eq!(on_terminal("-q").as_deref(), Some(""));
    let run = folder.succeeds(&long);
    assert_eq!(run.stderr, "");
}
