//! Too much for a run: more than its memory, more than a file should be, more of everything.

use std::ffi::{OsStr, OsString};
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;

use super::{is_told, png, sh};
use crate::{Folder, TRIANGLE, alberti};

/// A net of so many squares a side.
fn net(side: usize) -> String {
    let mut text = String::new();
    for k in 0..=side {
        (0..=side).for_each(|i| _ = writeln!(text, "v {i} {k} {}", i * k % 7));
    }
    for (k, i) in (0..side).flat_map(|k| (1..=side).map(move |i| (k, i))) {
        let at = k * (side + 1) + i;
        _ = writeln!(text, "f {at} {} {} {}", at + 1, at + side + 2, at + side + 1);
    }
    text
}

fn gzip(piece: &[u8], times: usize) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    (0..times).for_each(|_| encoder.write_all(piece).expect("in memory"));
    encoder.finish().expect("in memory")
}

#[test]
fn memory_is_asked_for_before_it_is_taken() {
    let scene = |render: &str| format!("{render}[[object]]\nmodel = \"net.obj\"\n");
    let files = [
        ("m.obj", TRIANGLE.to_owned().into_bytes()),
        ("net.obj", net(150).into_bytes()),
        ("flood.obj.gz", gzip(&b"v 1 2 3\n".repeat(1 << 10), 1 << 12)),
        ("grey.png", png(1024, true)),
        ("s.toml", scene("[render]\nmemory = \"3M\"\nsize = [32, 24]\n").into_bytes()),
        ("t.toml", scene("[render]\nmemory = \"3M\"\nsize = [640, 480]\n").into_bytes()),
        ("u.toml", scene("[render]\nmemory = 3.5\n").into_bytes()),
        ("v.toml", scene("[render]\nmemory = 3145728\nsize = [640, 480]\n").into_bytes()),
    ];
    let folder = Folder::with(&files.each_ref().map(|(name, bytes)| (*name, &bytes[..])));
    let small = "-s 32x24 --memory 3M";
    for (arguments, told) in [
        (
            "m.obj -s 640x480 --memory 3M",
            "error: --size: found a picture of 640x480 with 4 samples a pixel that takes ",
        ),
        (
            "m.obj -s 16384x16384 --memory 1G",
            "expected at most 1.0 GiB in all, as --memory says; make it smaller",
        ),
        ("m.obj -s 64x48 --show overdraw --memory 9k", "error: --size: found a picture of 64x48 that takes "),
        (
            &format!("m.obj {small} --texture grey.png"),
            "error: grey.png: found an image of 1024x1024 that takes ",
        ),
        (
            &format!("m.obj {small} --background grey.png"),
            "error: grey.png: found an image of 1024x1024 that ",
        ),
        (&format!("net.obj {small}"), "error: net.obj: found a model that takes "),
        ("flood.obj.gz -s 32x24 --memory 40M", "error: flood.obj.gz: found a model that takes "),
        ("s.toml", "error: s.toml:5: object.model: found a model that takes "),
        (
            "t.toml",
            "error: t.toml:3: render.size: found a picture of 640x480 with 4 samples a pixel that takes ",
        ),
        (
            "u.toml",
            "error: u.toml:2: render.memory: found floating point 3.5, expected text in quotes: a whole number of ",
        ),
        ("v.toml", "samples a pixel that takes 13.2 MiB of memory, expected at most 3.0 MiB in all"),
        (
            "m.obj --memory 1.5G",
            "error: --memory: found \"1.5G\", expected a whole number of bytes from 1 to 2^64 - 1, such as 512M",
        ),
    ] {
        let arguments: Vec<_> = arguments.split(' ').collect();
        folder.fails(&arguments, &[told]);
    }
    for arguments in [
        "m.obj -s 640x480 --memory 32M",
        "m.obj -s 32x24 --memory 32M --texture grey.png",
        "net.obj -s 32x24 --memory 64M",
        "s.toml --memory 64M",
    ] {
        folder.succeeds(&arguments.split(' ').collect::<Vec<_>>());
    }
    let made =
        alberti(&folder.path("."), &[OsStr::new("bake")], &["net.obj", "--memory", "3M", "--out", "b"]);
    is_told(&made, "error: net.obj: found a model that takes ");
    assert!(!folder.path("b").exists());
}

/// A process may have less than the machine: an error as any other, no abort, and the old picture.
#[cfg(target_os = "linux")]
#[test]
fn limits_of_memory_are_heeded() {
    let files =
        [("net.obj", net(500).into_bytes()), ("grey.png", png(4096, true)), ("out.png", b"old".to_vec())];
    let folder = Folder::with(&files.each_ref().map(|(name, bytes)| (*name, &bytes[..])));
    let before = folder.names();
    let mut failed = 0;
    for arguments in ["net.obj -s 32x24", "net.obj --texture grey.png -s 32x24", "-s 3000x3000 --samples 16"]
    {
        for mega in [150, 250, 400] {
            let line = format!("ulimit -v {} && exec \"$A\" {arguments} -j 2 -q -o out.png", mega << 10);
            let run = sh(&folder, &line);
            if run.status != Some(0) {
                is_told(&run, " of memory");
                assert!(run.stderr.contains(" in all, which are free; "), "{run:?}");
                failed += 1;
            }
            assert_eq!(folder.names(), before);
        }
    }
    assert!(failed > 3, "{failed}");
}

#[test]
fn bombs_are_small_errors() {
    let files = [
        ("m.obj", TRIANGLE.to_owned().into_bytes()),
        ("head.png", png(8192, false)),
        ("wide.png", png(100_000, false)),
        ("large.png", png(16384, true)),
        ("dust.obj.gz", gzip(&b"#\n".repeat(1 << 15), 1 << 8)),
    ];
    let folder = Folder::with(&files.each_ref().map(|(name, bytes)| (*name, &bytes[..])));
    assert!(files[3].1.len() < 4 << 20 && files[4].1.len() < 1 << 17);
    for (arguments, told) in [
        ("m.obj --texture head.png", "error: head.png: found a PNG image that "),
        (
            "m.obj --texture wide.png",
            "error: wide.png: found an image that is too large, expected 1 to 16384",
        ),
        ("m.obj --texture large.png", "error: large.png: found an image of 16384x16384, expected 1 to 16384"),
        ("dust.obj.gz", "error: dust.obj.gz: found no faces in 8388608 lines"),
        // The data of a picture as large as its head says are asked for before they are there.
        (
            "m.obj -s 32x24 --memory 100M --texture head.png",
            "error: head.png: found an image of 8192x8192 that ",
        ),
    ] {
        folder.fails(&arguments.split(' ').collect::<Vec<_>>(), &[told]);
    }
}

#[test]
fn scenes_may_have_many_of_all() {
    let mut scene = "size = [16, 12]\n[camera]\neye = [20, 12, 60]\ntarget = [20, 12, 0]\n".to_owned();
    for k in 0..1000 {
        let (x, y) = (k % 40, k / 40);
        let kind = if k % 2 == 0 { "model = \"m.obj\"" } else { "surface = \"plane\"\nsegments = [1, 1]" };
        _ = writeln!(scene, "[[object]]\n{kind}\nposition = [{x}, {y}, 0]\nmaterial = \"m{}\"", k % 200);
    }
    (0..200).for_each(|k| _ = writeln!(scene, "[material.m{k}]\ncolor = \"{:06x}\"", k * 83_521));
    let mut lights = scene.clone();
    for k in 0..20_000 {
        let (x, y) = (k % 200, k / 200);
        _ = writeln!(
            lights,
            "[[light]]\nkind = \"point\"\nposition = [{x}, {y}, 1]\nrange = 0.5\nintensity = 0.1"
        );
    }
    let files = [("m.obj", TRIANGLE.as_bytes()), ("s.toml", scene.as_bytes()), ("l.toml", lights.as_bytes())];
    let folder = Folder::with(&files);
    for (name, picture) in [("s.toml", "s.png"), ("l.toml", "l.png")] {
        let run = folder.succeeds(&[name, "--samples", "1", "-o", picture]);
        assert!(
            run.stdout.starts_with(&format!("{name}: 1500 triangles")) && run.stderr.is_empty(),
            "{run:?}"
        );
    }
    let [plain, lit] = ["s.png", "l.png"].map(|name| fs::read(folder.path(name)).expect("a picture"));
    assert_ne!(plain, lit);
    // The last of the lights is read as the first.
    let spoilt = lights.replacen("position = [199, 99, 1]", "position = [199, 99]", 1);
    fs::write(folder.path("l.toml"), &spoilt).expect("a file");
    let line = spoilt.lines().position(|line| line == "position = [199, 99]").expect("the line") + 1;
    folder.fails(&["l.toml"], &[&format!("error: l.toml:{line}: light.position: found ")]);
}

#[test]
fn text_in_sixteen_bits_is_told() {
    let wide = |text: &str, little: bool| -> Vec<u8> {
        let words = std::iter::once(0xfeff).chain(text.encode_utf16());
        words.flat_map(|word| if little { word.to_le_bytes() } else { word.to_be_bytes() }).collect()
    };
    for little in [true, false] {
        let folder = Folder::with(&[
            ("m.obj", &wide(TRIANGLE, little)),
            ("s.toml", &wide("[[object]]\nsurface = \"plane\"\n", little)),
            ("m.mtl", &wide("newmtl a\nKd 1 0 0\n", little)),
            ("n.obj", format!("mtllib m.mtl\nusemtl a\n{TRIANGLE}").as_bytes()),
            ("zero.toml", b"a = 0\0"),
        ]);
        folder.fails(&["m.obj"], &["error: m.obj: found UTF-16 text, expected a Wavefront OBJ model"]);
        let told = "error: s.toml: found UTF-16 text, expected a scene file in TOML; save it as UTF-8";
        folder.fails(&["s.toml"], &[told]);
        folder.fails(&["zero.toml"], &["error: zero.toml: found a binary file (a zero byte at offset 5)"]);
        let run = folder.succeeds(&["n.obj", "-s", "16x12"]);
        assert!(run.stderr.contains("m.mtl: found UTF-16 text, expected an MTL material library"), "{run:?}");
    }
}

/// Names with spaces, and with bytes that are no text, of all that is read and written.
#[cfg(target_os = "linux")]
#[test]
fn names_may_be_any_bytes() {
    use std::os::unix::ffi::OsStringExt as _;
    let folder = Folder::with(&[]);
    for odd in [&b"a b"[..], b"a \xff\xfe", "ä 犬".as_bytes()] {
        let named = |extension: &str| {
            let dot = if extension.is_empty() { "" } else { "." };
            OsString::from_vec([&b"d "[..], odd, b"/", odd, dot.as_bytes(), extension.as_bytes()].concat())
        };
        let at = |extension: &str| folder.0.path().join(named(extension));
        fs::create_dir(at("").parent().expect("a folder")).expect("a folder");
        let obj = [b"mtllib ", odd, b".mtl\nusemtl a\n", TRIANGLE.as_bytes()].concat();
        fs::write(at("obj"), obj).expect("a file");
        fs::write(at("mtl"), [b"newmtl a\nmap_Kd ", odd, b".png\n"].concat()).expect("a file");
        fs::write(at("toml"), "[[object]]\nsurface = \"plane\"\n").expect("a file");
        image::RgbImage::from_pixel(1, 1, image::Rgb([255, 0, 0])).save(at("png")).expect("a file");
        let word = OsString::from;
        let size = [word("-s"), word("32x24"), word("-o")];
        let run =
            folder.render(&[&[named("obj")], &size[..], &[named("qoi"), word("--shading=unlit")]].concat());
        assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
        let reds = image::open(at("qoi")).expect("a picture").to_rgb8();
        assert!(reds.pixels().any(|pixel| pixel.0 == [255, 0, 0]), "{odd:?}");
        let more = [named("bmp"), word("--texture"), named("png"), word("--aov=depth")];
        let run = folder.render(&[&[named("toml")], &size[..], &more].concat());
        assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
        assert!(at("depth.png").exists() && at("bmp").exists());
        let bake = [named("obj"), word("--out"), named("")];
        let run = alberti(folder.0.path(), &[OsStr::new("bake")], &bake);
        assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
        assert_eq!(fs::read_dir(at("")).expect("a folder").count(), 2);
    }
}
