//! `alberti watch`: the real command, whose files change.

#![cfg(unix)]

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::{Folder, alberti};
use std::ffi::OsStr;
use std::os::unix::process::ExitStatusExt as _;

const MODEL: &str =
    "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
const SCENE: &str = "size = [8, 8]\noutput = \"p.png\"\nbackground = \"000000\"\n[camera]\neye = [0, 0, 5]\n\
    target = [0, 0, 0]\n[render]\nshading = \"unlit\"\n[[object]]\nmodel = \"m.obj\"\n";

fn image(color: [u8; 3]) -> Vec<u8> {
    let mut file = std::io::Cursor::new(vec![]);
    let picture = image::RgbImage::from_pixel(2, 2, image::Rgb(color));
    picture.write_to(&mut file, image::ImageFormat::Png).expect("an image");
    file.into_inner()
}

/// A process that is killed where a test fails.
struct Watching(Child);

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Looks until it is so, for a long time: two minutes.
fn wait_for(name: &str, mut is: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is() {
        assert!(start.elapsed() < Duration::from_secs(120), "{name} does not happen");
        sleep(Duration::from_millis(20));
    }
}

/// Whether these tests run in the background of a script, whose processes ignore SIGINT.
pub(crate) fn ignores_sigint() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & 2 != 0)
}

#[test]
fn a_picture_follows_its_files() {
    let folder = Folder::with(&[
        ("m.obj", MODEL.as_bytes()),
        ("m.mtl", b"newmtl a\nKd 1 0 0\n"),
        ("s.toml", SCENE.as_bytes()),
    ]);
    let errors = fs::File::create(folder.path("errors")).expect("a file");
    let mut child = Watching(
        Command::new(env!("CARGO_BIN_EXE_alberti"))
            .current_dir(folder.0.path())
            .args(["watch", "s.toml", "-q", "--samples", "1"])
            .stdout(Stdio::null())
            .stderr(errors)
            .spawn()
            .expect("the command"),
    );
    let middle = || image::open(folder.path("p.png")).ok().map(|picture| picture.to_rgb8().get_pixel(4, 4).0);
    let write = |name: &str, text: &[u8]| fs::write(folder.path(name), text).expect("a file");
    let told = |part: &str| fs::read_to_string(folder.path("errors")).expect("text").contains(part);
    let red = [255, 0, 0];
    wait_for("the first picture", || middle() == Some(red));

    write("m.mtl", b"newmtl a\nKd 0 1 0\n");
    wait_for("a change of the library", || middle() == Some([0, 255, 0]));
    // Editors write another file, and give it the name.
    write("new", b"newmtl a\nKd 0 0 1\n");
    fs::rename(folder.path("new"), folder.path("m.mtl")).expect("a name");
    wait_for("a library that is replaced", || middle() == Some([0, 0, 255]));
    write("m.mtl", b"newmtl a\nKd 1 1 1\nmap_Kd t.png\n");
    wait_for("a library with a texture that is missing", || middle() == Some([255; 3]));
    write("t.png", &image([10, 20, 30]));
    wait_for("a texture that appears", || middle() == Some([10, 20, 30]));
    write("t.png", &image([90, 80, 70]));
    wait_for("a change of the texture", || middle() == Some([90, 80, 70]));

    write("s.toml", b"size = [8, 8");
    wait_for("an error in the scene", || told("error: s.toml:1: "));
    fs::remove_file(folder.path("s.toml")).expect("a file");
    wait_for("a scene that is gone", || told("error: s.toml: found no such file"));
    assert_eq!(middle(), Some([90, 80, 70]), "the last picture");
    write("s.toml", SCENE.as_bytes());
    write("m.obj", MODEL.replace("f 1/1", "f 9/1").as_bytes());
    wait_for("an error in the model", || told("found vertex index 9"));
    write("m.obj", MODEL.replace("usemtl a\n", "").as_bytes());
    wait_for("a model that is mended", || middle() == Some([204; 3]));

    let (signal, number) = if ignores_sigint() { ("-TERM", 15) } else { ("-INT", 2) };
    let sent = Command::new("kill").args([signal, &child.0.id().to_string()]).status();
    assert!(sent.expect("kill").success());
    let status = child.0.wait().expect("an end");
    // As shells have it: 130.
    assert_eq!(status.code().or(status.signal().map(|signal| 128 + signal)), Some(128 + number));
    assert_eq!(folder.names(), ["errors", "m.mtl", "m.obj", "p.png", "s.toml", "t.png"]);
}

/// A job that a shell has put into the background ignores SIGINT.
#[cfg(target_os = "linux")]
#[test]
fn signals_that_are_ignored_stay_so() {
    let folder = Folder::with(&[("m.obj", MODEL.as_bytes()), ("m.mtl", b"newmtl a\nKd 1 0 0\n")]);
    let script =
        "trap '' INT; exec \"$0\" watch m.obj -o p.png -q -s 8x8 --samples 1 --shading unlit --eye 0,0,5";
    let mut child = Watching(
        Command::new("sh")
            .current_dir(folder.0.path())
            .args(["-c", script, env!("CARGO_BIN_EXE_alberti")])
            .spawn()
            .expect("the command"),
    );
    let middle = || image::open(folder.path("p.png")).ok().map(|picture| picture.to_rgb8().get_pixel(4, 4).0);
    let send = |signal: &str| {
        let sent = Command::new("kill").args([signal, &child.0.id().to_string()]).status();
        assert!(sent.expect("kill").success());
    };
    wait_for("the first picture", || middle() == Some([255, 0, 0]));
    send("-INT");
    fs::write(folder.path("m.mtl"), "newmtl a\nKd 0 0 1\n").expect("a file");
    wait_for("a picture after the signal", || middle() == Some([0, 0, 255]));
    send("-TERM");
    assert_eq!(child.0.wait().expect("an end").signal(), Some(15));
}

#[test]
fn there_is_something_to_watch() {
    let folder = Folder::with(&[("m.obj", MODEL.as_bytes())]);
    for (arguments, part) in [
        (&["--scene", "floor"][..], "found nothing, expected a model or a scene file to watch"),
        (&["-"], "found standard input, expected a file"),
        (&["no.toml"], "no.toml: found no such file"),
        (&["no.obj"], "no.obj: found no such file"),
        (&["m.obj", "-o", "-"], "-o: found standard output, expected a file"),
        (&["m.obj", "-o", "m.gif"], "m.gif: found the extension"),
        (&["m.obj", "-o", "m.obj/m.png"], "m.obj/m.png: found a file in the place of its folder"),
    ] {
        let run = alberti(folder.0.path(), &[OsStr::new("watch")], arguments);
        assert_eq!(run.status, Some(2), "{run:?}");
        assert!(run.stderr.contains(part) && run.stderr.lines().count() == 1, "{run:?}");
    }
    assert_eq!(folder.names(), ["m.obj"]);
}
