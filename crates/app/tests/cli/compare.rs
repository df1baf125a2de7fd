//! `alberti compare`: measures of pictures whose differences are known, exit statuses, and wrong input.

use std::ffi::OsStr;
use std::fs;

use serde_json::{Value, json};

use crate::{Folder, Run, alberti};

impl Folder {
    /// Runs `alberti compare` with these arguments, separated by spaces.
    fn compare(&self, arguments: &str) -> Run {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        alberti(self.0.path(), &[OsStr::new("compare")], &arguments)
    }

    /// The line of JSON about two pictures, and the exit status.
    fn measures(&self, arguments: &str) -> (Value, Option<i32>) {
        let run = self.compare(&format!("{arguments} --json"));
        assert_eq!(run.stdout.lines().count(), 1, "{run:?}");
        (serde_json::from_str(&run.stdout).expect("JSON"), run.status)
    }

    /// Runs a comparison that cannot be made: status 2, one line with these parts, and all files as they were.
    fn refuses(&self, arguments: &str, parts: &[&str]) {
        let state = || self.names().into_iter().map(|name| fs::read(self.path(&name)).expect("a file"));
        let before: Vec<_> = state().collect();
        let run = self.compare(arguments);
        assert_eq!((run.status, run.stdout.as_str()), (Some(2), ""), "{run:?}");
        assert!(run.stderr.starts_with("error: ") && run.stderr.lines().count() == 1, "{run:?}");
        for part in ["found ", ", expected "].iter().chain(parts) {
            assert!(run.stderr.contains(part), "{part:?} is not in {}", run.stderr);
        }
        assert_eq!(state().collect::<Vec<_>>(), before);
    }

    /// Writes a picture in the format of its name.
    fn draw(&self, name: &str, [width, height]: [u32; 2], texel: impl Fn(u32, u32) -> [u8; 4]) {
        let picture = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba(texel(x, y)));
        picture.save(self.path(name)).expect("a picture for the test");
    }
}

const SIZE: [u32; 2] = [50, 40];

/// Pictures of 2000 pixels: grey, one with three pixels changed, one a step lighter, one of another size.
fn pictures() -> Folder {
    let folder = Folder::with(&[]);
    folder.draw("grey.png", SIZE, |_, _| [100, 100, 100, 255]);
    folder.draw("three.png", SIZE, |x, y| match (x, y) {
        (7, 2) => [100, 109, 100, 255],
        (7, 3) => [140, 100, 60, 255],
        (49, 39) => [97, 104, 100, 255],
        _ => [100, 100, 100, 255],
    });
    folder.draw("lighter.bmp", SIZE, |_, _| [101, 101, 101, 255]);
    folder.draw("wide.png", [51, 40], |_, _| [100, 100, 100, 255]);
    folder
}

#[test]
fn a_picture_equals_itself() {
    let folder = pictures();
    let run = folder.compare("grey.png grey.png --max-error 0lsb");
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""), "{run:?}");
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(lines[0], "grey.png and grey.png: 50x40 pixels");
    let figures: Vec<Vec<&str>> = lines[1..].iter().map(|line| line.split_whitespace().collect()).collect();
    let starts = [
        ["largest", "0", "lsb"],
        ["99.9", "percentile", "0"],
        ["outliers", "0", "pixels"],
        ["MSE", "0.0000", "lsb^2"],
        ["PSNR", "infinite", "dB"],
        ["FLIP", "0.000000", "mean"],
    ];
    assert_eq!(figures.len(), starts.len());
    assert!(figures.iter().zip(starts).all(|(found, start)| found[..3] == start), "{run:?}");
    for limit in ["0flip", "1000db"] {
        let (line, status) = folder.measures(&format!("grey.png grey.png --max-error {limit}"));
        assert_eq!(status, Some(0));
        assert_eq!(
            (&line["psnr"], &line["largest_at"], &line["within"]),
            (&Value::Null, &Value::Null, &json!(true))
        );
    }
}

#[test]
fn known_differences_have_their_measures() {
    let folder = pictures();
    let (line, status) = folder.measures("grey.png three.png");
    assert_eq!(status, Some(0));
    // Of 2000 pixels, one in a thousand is two: the third worst is left.
    for (key, expected) in [
        ("a", json!("grey.png")),
        ("b", json!("three.png")),
        ("width", json!(50)),
        ("height", json!(40)),
        ("largest", json!(40)),
        ("largest_at", json!([7, 3])),
        ("percentile_99_9", json!(4)),
        ("outliers", json!(2)),
    ] {
        assert_eq!(line[key], expected, "{key} in {line}");
    }
    let real = |line: &Value, key: &str| line[key].as_f64().expect("a number");
    // 9², 40² + 40², 3² + 4², over 6000 channels.
    let mse: f64 = (81.0 + 3200.0 + 25.0) / 6000.0;
    assert!((real(&line, "mse") - mse).abs() < 1e-12, "{line}");
    assert!((real(&line, "psnr") - 10.0 * (65025.0 / mse).log10()).abs() < 1e-9, "{line}");
    assert!(line.get("within").is_none() && line.get("max_error").is_none(), "{line}");
    // A step everywhere: MSE is 1, and PSNR 20 log10(255).
    let (line, _) = folder.measures("grey.png lighter.bmp");
    assert_eq!((real(&line, "mse"), &line["percentile_99_9"]), (1.0, &json!(1)));
    assert!((real(&line, "psnr") - 48.130_803_608_679_1).abs() < 1e-9, "{line}");
    // By NVIDIA's FLIP 1.7, of which more is said in the tests of `measure::flip`.
    folder.draw("red.png", [5, 3], |_, _| [255, 0, 0, 255]);
    folder.draw("green.png", [5, 3], |_, _| [0, 255, 0, 255]);
    let (line, _) = folder.measures("red.png green.png");
    assert!((real(&line, "flip") - 0.986_664_8).abs() < 1e-6, "{line}");
}

#[test]
fn alpha_is_told_by_steps_alone() {
    let folder = pictures();
    folder.draw("clear.png", SIZE, |_, _| [100, 100, 100, 55]);
    let (line, _) = folder.measures("grey.png clear.png");
    assert_eq!(
        (&line["largest"], &line["outliers"], &line["psnr"]),
        (&json!(200), &json!(2000), &Value::Null)
    );
    assert_eq!(line["flip"], json!(0.0));
}

#[test]
fn beyond_the_limit_the_status_is_one() {
    let folder = pictures();
    for (limit, exceeded) in [
        ("4lsb", None),
        ("3.5lsb", Some("exceeded: the 99.9 % percentile is 4 lsb, above 3.5lsb\n")),
        // PSNR is 10 log10(65025 / 0.551), 50.72 dB.
        ("50.7db", None),
        ("50.8DB", Some("exceeded: the PSNR is 50.719 dB, below 50.8db\n")),
        ("0.1flip", None),
        ("0flip", Some("exceeded: the mean FLIP is 0.0")),
    ] {
        let run = folder.compare(&format!("grey.png three.png --max-error {limit}"));
        assert_eq!(run.status, Some(i32::from(exceeded.is_some())), "{limit}: {run:?}");
        assert_eq!(run.stdout.lines().count(), 7, "{run:?}");
        assert!(run.stderr.starts_with(exceeded.unwrap_or_default()), "{limit}: {run:?}");
        assert_eq!(run.stderr.lines().count(), usize::from(exceeded.is_some()), "{limit}: {run:?}");
    }
    let (line, status) = folder.measures("three.png grey.png --max-error 3lsb");
    assert_eq!((status, &line["max_error"], &line["within"]), (Some(1), &json!("3lsb"), &json!(false)));
}

#[test]
fn heat_is_black_where_pictures_are_equal() {
    let folder = pictures();
    let run = folder.compare("grey.png three.png --heat heat.png --max-error 0lsb");
    assert_eq!(run.status, Some(1), "{run:?}");
    assert!(run.stdout.ends_with("\nFLIP of each pixel in heat.png\n"), "{run:?}");
    let heat = image::open(folder.path("heat.png")).expect("a picture").into_rgb8();
    assert_eq!(heat.dimensions(), (50, 40));
    let light = |x, y| heat.get_pixel(x, y).0.iter().copied().map(u32::from).sum::<u32>();
    assert_eq!(light(49, 0), 0);
    assert!(light(7, 3) > 200 && light(7, 3) > light(49, 39), "{} and {}", light(7, 3), light(49, 39));
}

#[test]
fn quiet_leaves_the_status() {
    let folder = pictures();
    for (limit, status) in [("255lsb", 0), ("0lsb", 1)] {
        let arguments = ["grey.png", "three.png", "-q", "--max-error", limit];
        let run = alberti(folder.0.path(), &[OsStr::new("compare")], &arguments);
        assert_eq!((run.status, run.stdout.as_str(), run.stderr.as_str()), (Some(status), "", ""), "{run:?}");
    }
}

#[test]
fn what_cannot_be_compared_is_said() {
    let folder = pictures();
    fs::write(folder.path("notes.png"), "no picture").expect("a file");
    folder.refuses("grey.png no.png", &["error: no.png: found no such file"]);
    folder.refuses("no.png grey.png", &["error: no.png: found no such file"]);
    folder.refuses("notes.png grey.png", &["error: notes.png: found a file of another format"]);
    folder.refuses("grey.png wide.png", &["error: wide.png: found 51x40 pixels", "50x40 as in grey.png"]);
}

#[test]
fn limits_that_mean_nothing_are_refused() {
    let folder = pictures();
    for (limit, part) in [
        ("2furlong", "--max-error: found \"2furlong\", expected one of the units lsb, flip, db and texel"),
        ("2", "--max-error: found \"2\", expected a number with its unit, as in 2lsb, 0.01flip or 40db"),
        ("x2lsb", "a number before the unit instead of \"x2\""),
        ("-1lsb", "--max-error: found \"-1lsb\", expected a number from 0 to 255 before lsb"),
        ("2flip", "a number from 0 to 1 before flip"),
        ("0.5texel", "--max-error: found a limit in texels, expected one in lsb, flip or db"),
    ] {
        folder.refuses(&format!("grey.png three.png --max-error {limit}"), &[part]);
    }
    folder.refuses("grey.png three.png --max-error 1texel", &["`alberti advise`"]);
}

#[test]
fn pictures_are_not_written_over() {
    let folder = pictures();
    let also_read = "found a file that is also read, expected another; choose another with --heat";
    folder.refuses("grey.png three.png --heat grey.png", &["error: grey.png: ", also_read]);
    folder.refuses("grey.png three.png --heat ./three.png", &["error: ./three.png: ", also_read]);
    folder.refuses("grey.png three.png --heat grey.png/h.png", &["error: grey.png/h.png: ", "with --heat"]);
    folder.refuses("grey.png three.png --heat h.gif", &["error: h.gif: ", ".png, .jpg"]);
    folder.refuses("grey.png wide.png --heat h.png", &["51x40"]);
}

#[test]
fn help_has_examples() {
    let run = Folder::with(&[]).compare("--help");
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""));
    for part in ["Exit status:", "Examples:", "40db", "lsb", "Alpha"] {
        assert!(run.stdout.contains(part), "{part} is not in {}", run.stdout);
    }
}
