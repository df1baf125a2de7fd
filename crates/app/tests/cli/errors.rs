//! Bad input: one line with the place, what was found and what was expected; status 2; no file.

use std::fs;

use crate::{Folder, TRIANGLE};

/// The error for a model with these contents.
fn model(contents: &[u8], parts: &[&str]) {
    Folder::with(&[("m.obj", contents)]).fails(&["m.obj", "-o", "out.png"], parts);
}

#[test]
fn files_that_are_not_models() {
    model(b"", &["error: m.obj: found an empty file", "a Wavefront OBJ model"]);
    model(b"\x89PNG\r\n\x1a\n\0\0\0\r", &["error: m.obj: found a binary file"]);
    model(b"\x7fELF\x02\x01\x01\0", &["error: m.obj: found a binary file"]);
    model(b"Dear reader,\nthis is no model.\n", &["error: m.obj: found no faces in 2 lines"]);
    model(b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", &["error: m.obj: found no faces in 3 lines"]);
    model(b"\xff\xfev\0 \x001\0", &["error: m.obj: found UTF-16 text"]);
    model(b"\xff\xff\xff\xff", &["error: m.obj: found no faces in 1 line,"]);
}

#[test]
fn numbers_that_are_not_coordinates() {
    for bad in ["nan", "NaN", "inf", "-inf", "1e400", "one", "1,5", "0x1p3"] {
        for keyword in ["v 0 0", "vt 0", "vn 0 1"] {
            // Of these, such words are taken for none.
            if keyword != "v 0 0" && ["nan", "NaN", "inf", "-inf"].contains(&bad) {
                continue;
            }
            let text = format!("# comment\n\n{keyword} {bad}\n{TRIANGLE}");
            model(
                text.as_bytes(),
                &["error: m.obj:3: ", &format!("found \"{bad}\", expected a finite number")],
            );
        }
    }
    model(b"v 1e30 0 0\n", &["m.obj:1: found a coordinate of 1e30, expected coordinates within"]);
    model(b"v 1 2\n", &["m.obj:1: found `v` with 2 numbers, expected 3"]);
    model(b"v 1 2 \\\n\\\n\nvt 0 x\n", &["m.obj:1: found `v` with 2 numbers"]);
}

#[test]
fn materials_without_their_numbers_keep_their_defaults() {
    for (mtl, found) in [
        ("newmtl red\nKd 1 2\n", "m.mtl:2: found `Kd` with 2 numbers, expected `Kd r g b`"),
        ("newmtl red\nKd\n", "m.mtl:2: found `Kd` with 0 numbers"),
        ("newmtl red\r\n\r\nKd x 1 1\r\n", "m.mtl:3: found \"x\" after `Kd`"),
        ("newmtl red\nKd nan 0 0\n", "m.mtl:2: found \"nan\" after `Kd`"),
    ] {
        let obj = format!("mtllib m.mtl\nusemtl red\n{TRIANGLE}");
        let folder = Folder::with(&[("m.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())]);
        let said = folder.succeeds(&["m.obj", "-o", "out.png"]).stderr;
        assert!(said.starts_with(&format!("warning: {found}")) && said.lines().count() == 1, "{said}");
        assert!(said.ends_with("; the line is left out\n"), "{said}");
    }
}

#[test]
fn indices_that_do_not_exist() {
    for (face, found) in [
        ("f 1 2 9", "found vertex index 9, expected 1 to 3"),
        ("f 0 1 2", "found vertex index 0, expected 1 to 3"),
        ("f 1/0 2/1 3/1", "found texture coordinate index 0, expected 1 to 3"),
        ("f 1/-5 2/1 3/1", "found texture coordinate index -5, expected -1 to -3"),
        ("f 1//2 2//1 3//1", "found normal index 2, expected 1 to 1"),
        ("f 1//9223372036854775807 2//1 3//1", "found normal index 9223372036854775807"),
        ("f 1//6148914691236517206 2//1 3//1", "found normal index 6148914691236517206"),
        ("f 1//-9223372036854775808 2//1 3//1", "found normal index -9223372036854775808"),
        ("f -4 -2 -1", "found vertex index -4, expected -1 to -3"),
        ("f 99999999999999999999999 1 2", "found vertex index 99999999999999999999999"),
        ("f a b c", "found \"a\" in a face, expected whole numbers"),
        ("f 1/1/1/1 2 3", "found \"1/1/1/1\" in a face"),
    ] {
        model(format!("{TRIANGLE}{face}\n").as_bytes(), &["error: m.obj:9: ", found]);
    }
}

#[test]
fn messages_stay_on_one_line() {
    model(b"v 0 0 \x1b[31mred\x07\xff\n", &["m.obj:1: found \"\\u{1b}[31mred\\u{7}\u{fffd}\""]);
    model(format!("v 0 0 {}\n", "x".repeat(100_000)).as_bytes(), &["xxx…xxx", "xxx\", expected"]);
    Folder::with(&[]).fails(&["a\nb.obj"], &["error: a\\nb.obj: found no such file"]);
}

#[test]
fn files_that_cannot_be_read() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    fs::create_dir(folder.path("d")).expect("a folder");
    folder.fails(&["no.obj"], &["error: no.obj: found no such file, expected a Wavefront OBJ model"]);
    folder.fails(&["d"], &["error: d: found a directory, expected a Wavefront OBJ model"]);
    folder.fails(&["m.obj", "--texture", "no.png"], &["error: no.png: found no such file, expected a PNG"]);
    folder.fails(&["m.obj", "--texture", "d"], &["error: d: found a directory, expected a PNG"]);
    folder.fails(&["m.obj/x"], &["error: m.obj/x: found "]);
    #[cfg(unix)]
    folder.fails(&["/dev/null"], &["error: /dev/null: found a device or a pipe"]);
}

/// A BMP header that claims a size, without the pixels.
fn bmp(width: i32, height: i32) -> Vec<u8> {
    let mut bytes = b"BM".to_vec();
    for field in [54, 0, 54, 40] {
        bytes.extend(u32::to_le_bytes(field));
    }
    bytes.extend(width.to_le_bytes());
    bytes.extend(height.to_le_bytes());
    bytes.extend([1, 0, 24, 0]);
    bytes.extend([0; 24]);
    bytes
}

/// A PNG header that claims a size, with its checksum, without the pixels.
fn png(width: u32, height: u32) -> Vec<u8> {
    let mut chunk = b"IHDR".to_vec();
    chunk.extend(width.to_be_bytes());
    chunk.extend(height.to_be_bytes());
    chunk.extend([8, 6, 0, 0, 0]);
    let crc = chunk.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 })
    });
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\r".to_vec();
    bytes.extend(chunk);
    bytes.extend((!crc).to_be_bytes());
    bytes.extend(b"\0\0\0\0IDAT");
    bytes
}

#[test]
fn textures_that_are_not_images() {
    let cases: [(&str, Vec<u8>); 11] = [
        ("empty.png", Vec::new()),
        ("text.png", b"hello".to_vec()),
        ("cut.png", png(4, 4)),
        ("zero.png", png(0, 4)),
        ("huge.png", png(2_000_000_000, 2_000_000_000)),
        ("wide.png", png(100_000, 1)),
        ("much.png", png(16384, 16384)),
        ("zero.bmp", bmp(0, 0)),
        ("huge.bmp", bmp(i32::MAX, i32::MAX)),
        ("wide.bmp", bmp(20_000, 1)),
        ("min.bmp", bmp(1, i32::MIN)),
    ];
    for (name, bytes) in cases {
        let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), (name, &bytes)]);
        folder.fails(&["m.obj", "--texture", name], &[&format!("error: {name}: found ")]);
    }
}

#[test]
fn cameras_that_see_nothing() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for (arguments, parts) in [
        ("--near 5 --far 5", "error: --far: found near 5 and far 5, expected near < far"),
        ("--near 6 --far 5", "error: --far: found near 6 and far 5"),
        ("--near 1e6", "error: --near: found near 1000000 and far "),
        ("--near 0", "error: --near: found near 0, expected"),
        ("--near -1", "error: --near: found near -1, expected"),
        ("--near nan", "error: --near: found \"nan\", expected a finite number"),
        ("--far inf", "error: --far: found \"inf\", expected a finite number"),
        ("--eye 1,2,3 --target 1,2,3", "error: --eye: found the eye and its target both at 1,2,3"),
        ("--up 0,0,0", "error: --up: found 0,0,0"),
        ("--eye 1,nan,3", "error: --eye: found \"1,nan,3\", expected three finite numbers"),
        ("--eye 1,2", "error: --eye: found \"1,2\", expected three finite numbers"),
        ("--target 1e400,0,0", "error: --target: found \"1e400,0,0\""),
        ("--up -inf,0,0", "error: --up: found \"-inf,0,0\""),
        ("--up w", "such as 0,1.5,-3, or one of x, y, z, -x, -y, -z"),
        ("--fov 0", "error: --fov: found 0 degrees, expected an angle above 0 and below 180"),
        ("--fov 180", "error: --fov: found 180 degrees"),
        ("--fov -20", "error: --fov: found -20 degrees"),
        ("--fov nan", "error: --fov: found \"nan\", expected a finite number"),
    ] {
        let arguments: Vec<_> = "m.obj -o out.png".split(' ').chain(arguments.split(' ')).collect();
        folder.fails(&arguments, &[parts]);
    }
}

#[test]
fn sizes_colours_and_threads_that_are_none() {
    let folder = Folder::with(&[]);
    for size in ["0x480", "640x0", "0x0", "100000x100000", "16385x1", "640", "axb", "-1x4", ""] {
        folder
            .fails(&["--size", size], &[&format!("error: --size: found \"{size}\", expected WIDTHxHEIGHT")]);
    }
    for threads in ["0", "-1", "257", "two", "1.5", ""] {
        let found = format!("error: --threads: found \"{threads}\", expected a whole number from 1 to 256");
        folder.fails(&["--threads", threads], &[&found]);
    }
    for color in ["reddish", "ffff", "12345g", "+12345", "#12345", "1234567", ""] {
        let found = format!("error: --background: found \"{color}\", expected hexadecimal digits");
        folder.fails(&["--background", color], &[&found]);
    }
}

#[test]
fn options_that_take_one_of_some_values() {
    let folder = Folder::with(&[]);
    for (arguments, expected) in [
        (&["--subpixel", "7"][..], "--subpixel: found \"7\", expected one of 4, 8; see --help"),
        (&["--cull", "all"], "--cull: found \"all\", expected one of back, front, none; see --help"),
        (
            &["--cull", "frnt"],
            "--cull: found \"frnt\", expected one of back, front, none; did you mean front?",
        ),
        (&["--filter"], "--filter: found nothing, expected a value; see --help"),
    ] {
        folder.fails(arguments, &[&format!("error: {expected}")]);
    }
}

#[test]
fn places_of_far_models_are_their_authors() {
    let far = "v 500000 120 4000000\nv 500001 120 4000000\nv 500000 121 4000000\nf 1 2 3\n";
    let tiny = "v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nf 1 2 3\n";
    let folder = Folder::with(&[("far.obj", far.as_bytes()), ("tiny.obj", tiny.as_bytes())]);
    let at = "500000,120,4000000";
    for (arguments, part) in [
        (
            vec!["far.obj", "--eye", at, "--target", at],
            "error: --eye: found the eye and its target both at 500000,120,4000000,",
        ),
        (
            vec!["far.obj", "--projector", "p.png", "--projector-eye", at, "--projector-target", at],
            "error: --projector-eye: found the eye and its target both at 500000,120,4000000,",
        ),
        // The model is at fault, and not the eye.
        (
            vec!["tiny.obj", "--eye", "0,0,1e-40"],
            "error: tiny.obj: found a model of radius 7.07e-41, expected one from",
        ),
        // The planes are not the user's.
        (vec!["far.obj", "--eye", "1e30,0,0"], "error: --eye: found an eye at 1"),
        (vec!["far.obj", "--fov", "1e-30"], "error: --fov: found 1e-30 degrees"),
    ] {
        folder.fails(&arguments, &[part]);
    }
}

#[test]
fn options_of_materials_that_are_none() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for (arguments, part) in [
        ("--filter cubic", "error: --filter: found \"cubic\", expected nearest, bilinear, trilinear or"),
        ("--filter anisotropic:3", "expected nearest, bilinear, trilinear or anisotropic:N with N = 2, 4, 8"),
        (
            "--normal-space object",
            "error: --normal-space: found a model without a normal map, expected a normal map for it; give one with --normal-map",
        ),
        ("--normal-strength 2", "error: --normal-strength: found a model without a normal map"),
        ("--relief steep", "error: --relief: found a model without a height map"),
        ("--height-range 0,1", "error: --height-range: found a model without a height map"),
        ("--environment-kind cube", "error: --environment-kind: found a model without an environment"),
        ("--reflection 1", "error: --reflection: found a model without an environment"),
        ("--reflection 2", "error: --reflection: found \"2\", expected a number from 0 to 1"),
        ("--height-range 1", "error: --height-range: found \"1\", expected two finite numbers LO,HI"),
        ("--normal-strength -1", "error: --normal-strength: found \"-1\", expected a number from 0 to 100"),
        (
            "--shininess 9,8",
            "error: --shininess: found \"9,8\", expected a number from 0 to 65536, or a least",
        ),
        ("--specular reddish", "error: --specular: found \"reddish\", expected hexadecimal digits"),
        ("--normal-map no.png", "error: no.png: found no such file"),
        ("--height-map m.obj", "error: m.obj: found a file of another format"),
    ] {
        let arguments: Vec<_> = "m.obj -o out.png".split(' ').chain(arguments.split(' ')).collect();
        folder.fails(&arguments, &[part]);
    }
}

#[test]
fn options_of_maps_that_a_built_in_scene_has_not() {
    let folder = Folder::with(&[]);
    for (arguments, partner) in [
        ("--relief steep", "--height-map"),
        ("--height-range 0,1", "--height-map"),
        ("--normal-space object", "--normal-map"),
        ("--environment-kind cube", "--environment"),
    ] {
        let arguments: Vec<_> = ["--scene", "floor"].into_iter().chain(arguments.split(' ')).collect();
        let part = format!("error: {}: found it without {partner}, expected {partner} as well", arguments[2]);
        folder.fails(&arguments, &[&part]);
    }
}

#[test]
fn outputs_that_cannot_be_written() {
    let folder = Folder::with(&[("file", b""), ("m.obj", b"broken"), ("t.png", b"")]);
    fs::create_dir(folder.path("d.png")).expect("a folder");
    folder.fails(
        &["-o", "out.gif"],
        &["error: out.gif: found the extension \".gif\"", ".png, .jpg, .jpeg, .bmp, .tga"],
    );
    folder.fails(&["-o", "out"], &["error: out: found no extension"]);
    folder.fails(&["-o", "d.png"], &["error: d.png: found a directory"]);
    // Before anything is read, so that nobody waits for a picture that has no place.
    folder.fails(
        &["m.obj", "-o", "file/out.png"],
        &["error: file/out.png: found a file in the place of its folder"],
    );
    folder.fails(&["--texture", "t.png", "-o", "t.png"], &["error: t.png: found a file that is also read"]);
}

/// Textures and materials are known when they have been read.
#[test]
fn none_of_a_models_own_files_is_written() {
    let model = format!("mtllib m.mtl\nusemtl a\n{TRIANGLE}");
    let scene = "[render]\nsize = [32, 24]\n[[object]]\nmodel = \"m.obj\"\n";
    let folder = Folder::with(&[
        ("m.obj", model.as_bytes()),
        ("m.mtl", b"newmtl a\nmap_Kd my.depth.png\n"),
        ("s.toml", scene.as_bytes()),
    ]);
    folder.succeeds(&["--scene", "cube", "-s", "8x8", "-o", "my.depth.png"]);
    let before = folder.names();
    let texture = std::fs::read(folder.path("my.depth.png")).expect("a picture");
    for (arguments, name) in [
        ("m.obj -o my.depth.png", "my.depth.png"),
        ("m.obj -o ./my.depth.png", "./my.depth.png"),
        ("m.obj -o m.mtl --output-format png", "m.mtl"),
        ("m.obj -o my.png --aov depth", "my.depth.png"),
        ("s.toml -o my.depth.png", "my.depth.png"),
        ("s.toml -o m.obj --output-format png", "m.obj"),
    ] {
        let told = format!(
            "error: {name}: found a file that is also read, expected another; choose another with -o"
        );
        folder.fails(&arguments.split(' ').collect::<Vec<_>>(), &[&told]);
    }
    assert_eq!(folder.names(), before);
    assert_eq!(std::fs::read(folder.path("my.depth.png")).expect("a picture"), texture);
}

#[test]
fn a_failure_leaves_the_old_picture() {
    let folder = Folder::with(&[("m.obj", b"f 1 2 3\n"), ("out.png", b"old")]);
    folder.fails(&["m.obj", "-o", "out.png"], &["error: m.obj:1: found vertex index 1, expected none"]);
    assert_eq!(fs::read(folder.path("out.png")).expect("the old picture"), b"old");
}

#[test]
fn usage_errors_have_the_same_status() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for arguments in
        ["--no-such-option", "m.obj --scene hero", "--scene nowhere", "--wrap round", "a.obj b.obj"]
    {
        let arguments: Vec<_> = arguments.split(' ').collect();
        let run = folder.render(&arguments);
        assert_eq!(run.status, Some(2), "{run:?}");
        assert!(run.stderr.starts_with("error: "), "{run:?}");
    }
    assert_eq!(folder.names(), ["m.obj"]);
}

/// One rule for all commands: 0 where all is done, 1 where pictures differ by more than may be, 2 where input is wrong.
#[test]
fn all_commands_have_the_same_statuses() {
    let spoilt: &[u8] = b"v 0 0 zero\n";
    let files = [("m.obj", TRIANGLE.as_bytes()), ("bad.obj", spoilt), ("bad.toml", b"[render]\nfog = 3\n")];
    let folder = Folder::with(&files);
    folder.succeeds(&["m.obj", "--size", "32x24", "-o", "a.png"]);
    folder.succeeds(&["m.obj", "--size", "32x24", "-o", "b.png", "--background", "ffffff"]);
    let small = "--size 32x24";
    let commands = [
        ("render", format!("m.obj -o c.png {small}"), "m.obj", "-o c.png"),
        ("bake", format!("m.obj --out out {small}"), "m.obj", "--out out"),
        ("explain", format!("m.obj --pixel 1,1 {small}"), "m.obj", "--pixel 1,1"),
        ("advise", format!("m.obj --target m0 {small}"), "m.obj", ""),
        ("compare", "a.png a.png".to_owned(), "a.png", "a.png"),
    ];
    let run = |command: &str, arguments: &str| {
        let words: Vec<_> = arguments.split_whitespace().collect();
        crate::alberti(folder.0.path(), &[std::ffi::OsStr::new(command)], &words)
    };
    for (command, right, input, rest) in &commands {
        let done = run(command, right);
        assert!(done.status == Some(0) && !done.stderr.contains("error"), "{command}: {done:?}");
        let before = folder.names();
        let missing = input.replace("m.", "no.").replace("a.", "no.");
        for wrong in [
            format!("{right} --no-such-option"),
            format!("{missing} {rest}"),
            format!("bad.obj {rest}"),
            format!("bad.toml {rest}"),
            format!("{right} --size 0x1"),
            String::from("--size"),
        ] {
            let failed = run(command, &wrong);
            assert_eq!((failed.status, &failed.stdout[..]), (Some(2), ""), "{command} {wrong}: {failed:?}");
            assert!(failed.stderr.starts_with("error: "), "{command} {wrong}: {failed:?}");
            assert_eq!(folder.names(), before, "{command} {wrong}");
        }
    }
    assert_eq!(run("compare", "a.png b.png --max-error 1lsb").status, Some(1));
    assert_eq!(run("compare", "a.png b.png").status, Some(0));
    // Without a command there is help; with one that is none, there is not.
    assert_eq!(run("paint", "m.obj").status, Some(2));
}
