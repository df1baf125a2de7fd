//! Films of a turntable, and films of pictures: each format by a decoder of others.

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;
use std::process::Command;

use image::AnimationDecoder as _;
use image::codecs::webp::WebPDecoder;

use crate::{Folder, Run, alberti};

mod moving;
mod standing;

/// A roof in two colours, and a triangle before it.
const MODEL: &str = "mtllib m.mtl\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv 0 1 1\nv 0 1 -1\n\
    usemtl red\nf 1 2 5\nf 2 3 6 5\nusemtl blue\nf 3 4 6\nf 4 1 5 6\n";
const MTL: &[u8] = b"newmtl red\nKd 0.9 0.2 0.1\nnewmtl blue\nKd 0.1 0.3 0.9\n";

const SIZE: [u32; 2] = [40, 30];

fn folder() -> Folder {
    Folder::with(&[("m.obj", MODEL.as_bytes()), ("m.mtl", MTL)])
}

fn run(folder: &Folder, line: &str) -> Run {
    let words: Vec<_> = line.split_whitespace().collect();
    alberti(&folder.path(""), &[], &words)
}

/// Runs a command that has to succeed, and has nothing to say.
fn made(folder: &Folder, line: &str) -> String {
    let run = run(folder, line);
    assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{line}: {run:?}");
    run.stdout
}

/// Red, green and blue of a picture.
fn picture(folder: &Folder, name: &str) -> Vec<u8> {
    let picture = image::open(folder.path(name)).expect("a picture");
    assert_eq!([picture.width(), picture.height()], SIZE);
    picture.into_rgb8().into_raw()
}

/// The frames of an animated PNG, and the delay of the first.
fn apng(folder: &Folder, name: &str) -> (Vec<Vec<u8>>, [u16; 2]) {
    let file = File::open(folder.path(name)).expect("a film");
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().expect("a header");
    let count = reader.info().animation_control.expect("an animation").num_frames;
    let mut delay = [0; 2];
    let frames = (0..count).map(|_| {
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut bytes).expect("a frame");
        let control = reader.info().frame_control.expect("a delay");
        delay = [control.delay_num, control.delay_den];
        bytes
    });
    (frames.collect(), delay)
}

#[test]
fn films_that_cannot_be_shown_say_so() {
    let folder = folder();
    let told = run(&folder, "turntable m.obj --frames 2 -s 8x8 --fps 60 -o a.gif");
    assert!(
        told.stderr.starts_with("warning: a.gif: found 60 frames a second, expected at most 50"),
        "{told:?}"
    );
    made(&folder, "turntable m.obj --frames 2 -s 8x8 --fps 50 -o a.gif");
    made(&folder, "turntable m.obj --frames 2 -s 8x8 --fps 60 -o a.webp");
    made(&folder, "turntable m.obj --frames 2 -s 40x30 --fps 29.97 -o a.png");
    assert_eq!(apng(&folder, "a.png").1, [1001, 30_000]);
    made(&folder, "turntable m.obj --frames 2 -s 8x8 --fps 29.97 -o a.y4m");
    assert!(fs::read(folder.path("a.y4m")).expect("a film").starts_with(b"YUV4MPEG2 W8 H8 F30000:1001 "));
    let failed = run(&folder, "turntable m.obj -o -");
    assert_eq!(
        failed.stderr,
        "error: -o: found standard output, expected a file, as films are written whole\n"
    );
}

#[test]
fn frames_are_the_pictures_from_around() {
    let folder = folder();
    let planes = "--target 0,0.5,0 --near 1 --far 9 -s 40x30";
    let told = made(&folder, &format!("turntable m.obj --eye 2,1.5,3 {planes} --frames 4 -o f/%02d.png"));
    assert!(told.starts_with("m.obj: 6 triangles, 4 frames of 40x30 pixels in f/%02d.png; load "), "{told}");
    for (frame, eye) in ["2,1.5,3", "3,1.5,-2", "-2,1.5,-3", "-3,1.5,2"].into_iter().enumerate() {
        made(&folder, &format!("m.obj --eye {eye} {planes} -o right.png"));
        assert!(picture(&folder, &format!("f/0{frame}.png")) == picture(&folder, "right.png"), "{frame}");
    }
    // The other way, and over the top.
    made(&folder, &format!("turntable m.obj --eye 2,1.5,3 {planes} --frames 4 --degrees -360 -o b/%d.png"));
    assert!(picture(&folder, "b/1.png") == picture(&folder, "f/03.png"));
    let over = "--axis 1,0,0 --degrees 90 --frames 2";
    made(&folder, &format!("turntable m.obj --eye 0,0.5,4 {planes} {over} -o o/%d.png"));
    made(&folder, &format!("m.obj --eye 0,0.5,4 {planes} -o right.png"));
    assert!(picture(&folder, "o/0.png") == picture(&folder, "right.png"));
    assert!(picture(&folder, "o/1.png") != picture(&folder, "right.png"));
}

#[test]
fn all_formats_have_the_same_frames() {
    let folder = folder();
    let film = "turntable m.obj -s 40x30 --frames 5 --fps 30 --ground";
    for name in ["a.png", "a.gif", "a.webp", "f/%d.png"] {
        let told = made(&folder, &format!("{film} -o {name}"));
        // Without those of the ground.
        assert!(told.starts_with("m.obj: 6 triangles, 5 frames "), "{told}");
    }
    let right: Vec<_> = (0..5).map(|frame| picture(&folder, &format!("f/{frame}.png"))).collect();
    assert!(right.windows(2).all(|pair| pair[0] != pair[1]));

    assert!(apng(&folder, "a.png") == (right.clone(), [1, 30]));
    let file = BufReader::new(File::open(folder.path("a.webp")).expect("a film"));
    let frames = WebPDecoder::new(file).expect("a film").into_frames().collect_frames().expect("frames");
    let delays: Vec<_> = frames.iter().map(|frame| frame.delay().numer_denom_ms().0).collect();
    assert_eq!(delays, [33, 34, 33, 33, 34]);
    let colors = frames.into_iter().map(|frame| {
        frame.into_buffer().pixels().flat_map(|pixel| [pixel.0[0], pixel.0[1], pixel.0[2]]).collect()
    });
    assert!(colors.collect::<Vec<Vec<u8>>>() == right);

    // 256 colours are near those of each frame, which lies over the one before.
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(File::open(folder.path("a.gif")).expect("a film")).expect("a header");
    assert_eq!([decoder.width(), decoder.height()].map(u32::from), SIZE);
    let (mut shown, mut delays) = (vec![0_u8; right[0].len()], Vec::new());
    for right in &right {
        let frame = decoder.read_next_frame().expect("a frame").expect("as many").clone();
        delays.push(frame.delay);
        let width = usize::from(frame.width);
        for (row, texels) in frame.buffer.chunks(4 * width).enumerate() {
            let start = 3 * ((usize::from(frame.top) + row) * 40 + usize::from(frame.left));
            let colors = texels.chunks(4).flat_map(|texel| &texel[..3]);
            shown[start..].iter_mut().zip(colors).for_each(|(to, from)| *to = *from);
        }
        let sum: u64 = shown.iter().zip(right).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        let (mean, most) =
            (sum / right.len() as u64, shown.iter().zip(right).map(|(a, b)| a.abs_diff(*b)).max());
        assert!(mean <= 3 && most <= Some(80), "{mean} {most:?}");
    }
    assert_eq!(delays, [3, 4, 3, 3, 4]);
    assert!(decoder.read_next_frame().expect("an end").is_none());
}

#[test]
fn shares_make_the_film_of_one_process() {
    let folder = folder();
    let film = "turntable m.obj -s 40x30 --frames 7";
    for (shard, variables) in [
        ("--shard 0/4 -q", &[][..]),
        ("--shard 3/4 -q", &[]),
        (
            "-q",
            &[("SLURM_ARRAY_TASK_ID", "6"), ("SLURM_ARRAY_TASK_MIN", "5"), ("SLURM_ARRAY_TASK_COUNT", "4")],
        ),
        ("--shard /4 -q", &[("JOB_COMPLETION_INDEX", "2")]),
    ] {
        let words = format!("{film} {shard} -o f/%03d.png");
        let mut command = Command::new(env!("CARGO_BIN_EXE_alberti"));
        command.current_dir(folder.path("")).args(words.split_whitespace());
        let output = command.envs(variables.iter().copied()).output().expect("the command");
        assert!(
            output.status.success() && output.stdout.is_empty() && output.stderr.is_empty(),
            "{output:?}"
        );
    }
    let count = fs::read_dir(folder.path("f")).expect("frames").count();
    assert_eq!(count, 7);
    for name in ["gif", "png", "webp", "y4m"] {
        made(&folder, &format!("{film} -o one.{name}"));
        made(&folder, &format!("assemble f/%03d.png -o all.{name}"));
        let [one, all] = ["one", "all"].map(|film| fs::read(folder.path(&format!("{film}.{name}"))));
        let (one, all) = (one.expect("a film"), all.expect("a film"));
        assert!(one == all && one.len() > 1000, "{name}");
    }
    // A picture of that size is not drawn again, whatever it shows; all else is.
    let blank = image::RgbImage::new(40, 30);
    blank.save(folder.path("f/000.png")).expect("a picture");
    image::RgbImage::new(30, 40).save(folder.path("f/001.png")).expect("a picture");
    fs::write(folder.path("f/002.png"), "cut off").expect("a file");
    let told = made(&folder, &format!("{film} --shard 0/2 -o f/%03d.png"));
    assert!(told.contains(", 2 frames of share 0/2 beside 1 that were there of 40x30 pixels"), "{told}");
    assert!(picture(&folder, "f/000.png") == blank.into_raw());
    let told = made(&folder, &format!("{film} --shard 0/1 -o f/%03d.png"));
    assert!(told.contains(", 0 frames beside 7 that were there of"), "{told}");
    let told = made(&folder, &format!("{film} -o f/%03d.png"));
    assert!(told.contains(", 7 frames of 40x30 pixels"), "{told}");

    // A film without a picture in its middle is none.
    fs::remove_file(folder.path("f/003.png")).expect("a picture");
    let run = run(&folder, "assemble f/%03d.png -o gap.gif");
    let expected =
        "error: f/003.png: found no such picture, expected all up to the last, since f/004.png is there\n";
    assert_eq!((run.status, &run.stderr[..]), (Some(2), expected));
    assert!(!folder.path("gap.gif").exists());
    for name in ["f/000.png", "f/001.png", "f/002.png"] {
        fs::remove_file(folder.path(name)).expect("a picture");
    }
    let told = made(&folder, "assemble f/%03d.png -o rest.gif");
    assert!(told.starts_with("f/%03d.png: 3 frames from 4 on of 40x30 pixels"), "{told}");
}

#[test]
fn what_is_seen_through_stays_so() {
    let folder = folder();
    let film = "turntable m.obj -s 40x30 --frames 3 --background transparent";
    for name in ["a.png", "a.gif", "f/%d.png"] {
        made(&folder, &format!("{film} -o {name}"));
    }
    let (frames, _) = apng(&folder, "a.png");
    let first = image::open(folder.path("f/0.png")).expect("a picture").into_rgba8().into_raw();
    assert!(frames[0] == first && first.chunks(4).any(|texel| texel[3] == 0));
    // Also if the first frame is full.
    let full =
        "turntable m.obj -s 40x30 --frames 2 --eye 0,0.3,1.4 --target 0,0.3,0 --background transparent";
    for name in ["b.png", "g/%d.png"] {
        made(&folder, &format!("{full} -o {name}"));
    }
    made(&folder, "assemble g/%d.png -o c.png");
    let [pictures, joined] = ["b.png", "c.png"].map(|name| apng(&folder, name).0);
    assert!(pictures == joined && pictures[1].len() == 4800);
    // Where it would be lost, nothing is written.
    let refused = run(&folder, "assemble f/%d.png -o lost.y4m");
    let told =
        "error: f/0.png: found a transparent picture, expected opaque ones, or -o with gif, png or webp";
    assert_eq!((refused.status, refused.stderr.trim_end()), (Some(2), told));
    assert!(!folder.path("lost.y4m").exists());

    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(File::open(folder.path("a.gif")).expect("a film")).expect("a header");
    let frame = decoder.read_next_frame().expect("a frame").expect("one");
    assert_eq!(frame.dispose, gif::DisposalMethod::Background);
    for (found, right) in frame.buffer.chunks(4).zip(first.chunks(4)) {
        // Between the two it is dithered.
        assert!([0, 255].contains(&found[3]) && ((1..255).contains(&right[3]) || found[3] == right[3]));
    }
}

/// A program in the place of ffmpeg gets the pictures, and what it says is told.
#[cfg(unix)]
#[test]
fn other_formats_are_made_by_ffmpeg() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    fs::create_dir(folder.path("bin")).expect("a folder");
    let play = |script: &str| {
        fs::write(folder.path("bin/ffmpeg"), format!("#!/bin/sh\n{script}\n")).expect("a program");
        let mode = fs::Permissions::from_mode(0o755);
        fs::set_permissions(folder.path("bin/ffmpeg"), mode).expect("a program");
        let path = format!("{}:/usr/bin:/bin", folder.path("bin").display());
        let mut command = Command::new(env!("CARGO_BIN_EXE_alberti"));
        let words = "turntable m.obj -s 40x30 --frames 3 --fps 24 -o a.mp4 -q";
        command.current_dir(folder.path("")).args(words.split_whitespace()).env("PATH", path);
        command.output().expect("the command")
    };
    let output = play("test $# -lt 2 || { for last; do :; done; cat > \"$last\"; }");
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    let film = fs::read(folder.path("a.mp4")).expect("a film");
    let head = b"YUV4MPEG2 W40 H30 F24:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
    assert!(film.starts_with(head) && film.len() == head.len() + 3 * (6 + 3600));
    assert!(film[head.len()..].chunks(3606).all(|frame| frame.starts_with(b"FRAME\n")));

    fs::remove_file(folder.path("a.mp4")).expect("a film");
    let output = play("test $# -lt 2 || { cat > /dev/null; echo odd width >&2; exit 1; }");
    let told = String::from_utf8_lossy(&output.stderr);
    let expected = "error: a.mp4: found that ffmpeg fails (\"odd width\"), expected a film that it encodes, ";
    assert!(output.status.code() == Some(2) && told.starts_with(expected), "{told}");
    assert!(!folder.path("a.mp4").exists());
    let output = play("exit 0");
    assert!(output.status.code() == Some(2), "{output:?}");
}

#[test]
fn mistakes_are_told() {
    let folder = folder();
    fs::write(folder.path("0.png"), "no picture").expect("a file");
    for (line, told) in [
        (
            "turntable m.obj -o a.jpg",
            "a.jpg: found the extension \".jpg\", expected one of .gif, .png, .apng, ",
        ),
        ("turntable m.obj -o a", "a: found no extension, expected one of .gif, "),
        (
            "turntable m.obj -o m.obj/%d.png",
            "m.obj/0.png: found a file in the place of its folder, expected a file that can be written; choose another",
        ),
        ("turntable m.obj -o %d.tif", "0.tif: found the extension \".tif\""),
        ("turntable m.obj --frames 0", "--frames: found \"0\", expected a whole number from 1 to 100000"),
        (
            "turntable m.obj --fps 101",
            "--fps: found \"101\", expected a number from 0.01 to 100, of at most two decimals",
        ),
        ("turntable m.obj --shard 4/4", "--shard: found \"4/4\", expected K/N with K from 0 to N - 1"),
        ("turntable m.obj --shard 0/2", "--shard: found a share of a film in one file, expected pictures"),
        ("turntable m.obj --stats", "--stats: found an option that `turntable` has not"),
        ("turntable m.obj --axis 0,0,0", "--axis: found no direction, expected one"),
        ("turntable m.obj -o a.y4m --background transparent", "a.y4m: found a format without transparency"),
        ("turntable m.obj --frames 90000 --memory 64M", "--frames: found a film of 90000 frames that takes "),
        ("assemble f/%d.png", "f/%d.png: found no picture, expected one from f/0.png on"),
        ("assemble f.png", "f.png: found a name without a number"),
        (
            "assemble 0.png m.mtl -o a.gif",
            "m.mtl: found the names of several pictures, expected one name for all pictures, such as frames/%04d.png",
        ),
        ("assemble %d.png -o %d.png", "%d.png: found names of pictures, expected a film"),
        ("assemble %d.png", "0.png: found a file of another format"),
    ] {
        let run = run(&folder, line);
        assert_eq!((run.status, run.stderr.lines().count()), (Some(2), 1), "{line}: {run:?}");
        assert!(run.stderr.starts_with(&format!("error: {told}")), "{line}: {run:?}");
    }
    assert_eq!(folder.names(), ["0.png", "m.mtl", "m.obj"]);
}

/// The film on the first page is the one that its command makes, to the byte.
#[test]
fn the_first_page_shows_its_film() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = fs::read_to_string(root.join("README.md")).expect("the page");
    let (_, command) = page.split_once("cargo run --release -- turntable ").expect("a command");
    let (command, shown) = command.split_once('`').expect("its end");
    assert!(shown.starts_with(" makes\n\n![A knot that turns](docs/pictures/turntable.gif)\n"));
    let folder = Folder::with(&[]);
    made(&folder, &format!("turntable {command}"));
    let [found, right] = [folder.path("alberti.gif"), root.join("docs/pictures/turntable.gif")].map(fs::read);
    assert!(found.expect("a film") == right.expect("the page's film"));
}

/// The picture on the first page is the one that its command draws.
#[test]
fn the_first_page_shows_its_picture() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = fs::read_to_string(root.join("README.md")).expect("the page");
    assert!(
        page.contains("](docs/pictures/hero.png)")
            && page.contains("\ncargo run --release -- render\n```\n\ndraws")
    );
    let folder = Folder::with(&[]);
    made(&folder, "render");
    let [found, right] = [folder.path("alberti.png"), root.join("docs/pictures/hero.png")]
        .map(|path| image::open(path).expect("a picture").into_rgb8());
    assert!(found == right);
}

/// A turn that goes below: there the model has no ground, and above it has its own.
#[test]
fn a_ground_is_drawn_from_above_alone() {
    let folder = folder();
    let line = "turntable m.obj --size 40x30 --axis 1,0,0 --frames 4 --background ffffff";
    made(&folder, &format!("{line} -o a%d.png"));
    let said = run(&folder, &format!("{line} --ground -o b%d.png"));
    assert_eq!(said.status, Some(0), "{said:?}");
    assert!(said.stderr.contains("2 of 4 frames from below the model's lowest point"), "{said:?}");
    let same = [0, 1, 2, 3]
        .map(|k| picture(&folder, &format!("a{k}.png")) == picture(&folder, &format!("b{k}.png")));
    assert_eq!(same.iter().filter(|same| **same).count(), 2, "{same:?}");
    assert!(!same[0]);
}

/// Half of the pixels of a shadow in a format that knows clear and opaque alone.
#[test]
fn a_shadow_in_a_gif_is_dithered() {
    let folder = folder();
    made(&folder, "turntable m.obj --size 40x30 --frames 1 --ground --background transparent -o a.gif");
    made(&folder, "turntable m.obj --size 40x30 --frames 1 --ground --background transparent -o %d.png");
    let open = |name: &str| image::open(folder.path(name)).expect("a picture").into_rgba8();
    let [dithered, whole] =
        ["a.gif", "0.png"].map(|name| open(name).pixels().map(|p| p.0[3]).collect::<Vec<_>>());
    assert!(dithered.iter().all(|alpha| [0, 255].contains(alpha)));
    let [found, right] =
        [&dithered, &whole].map(|all| all.iter().map(|&alpha| u32::from(alpha)).sum::<u32>());
    assert!(found.abs_diff(right) < right / 20, "{found} {right}");
    let compared = run(&folder, "compare a.gif a.gif");
    assert!(compared.status == Some(0) && compared.stderr.is_empty(), "{compared:?}");
    made(&folder, "turntable m.obj --size 40x30 --frames 2 -o b.gif");
    let compared = run(&folder, "compare b.gif b.gif");
    assert!(compared.stderr.contains("b.gif: found a film, expected a picture"), "{compared:?}");
}
