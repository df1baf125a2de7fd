//! Assets for flash: files are what they say they lose, draw what the scene is, and cost what the report counts.

mod limits;
mod mistakes;
mod told;

use std::f64::consts::{PI, TAU};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use alberti::baked::{Attributes, Baked, Normal, Texels, Uv};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::One;
use alberti::raster::color;
use alberti::shaders::{Sunlit, Unlit};
use alberti::texture::{Bilinear, Repeat};
use alberti::{Cull, D16, F32Reversed, Geometry, Memory, Pass, Rgb565Be, Rgba8, Rgba8888, Target, Vector3};
use alberti_app::cli::advise::scene;
use alberti_app::draw::{AMBIENT, DIFFUSE, to_light, view};
use serde_json::Value;

use crate::{Folder, Run, TRIANGLE, alberti};

/// The rows and columns of the ball's vertices.
const ROWS: u32 = 24;
const COLUMNS: u32 = 32;

/// A ball of radius 2 with normals and texture coordinates up to 1 and 2, as an OBJ file.
fn ball() -> String {
    let (mut lines, mut faces) = (String::new(), String::new());
    for row in 0..=ROWS {
        for column in 0..=COLUMNS {
            let [u, v] = [(column, COLUMNS), (row, ROWS)].map(|(k, all)| f64::from(k) / f64::from(all));
            let ((sin, cos), (across, down)) = ((u * TAU).sin_cos(), (v * PI).sin_cos());
            let n = [across * sin, -down, across * cos];
            lines += &format!("v {} {} {}\n", 2.0 * n[0], 2.0 * n[1], 2.0 * n[2]);
            lines += &format!("vn {} {} {}\nvt {u} {}\n", n[0], n[1], n[2], 2.0 * v);
            if row < ROWS && column < COLUMNS {
                let at = row * (COLUMNS + 1) + column + 1;
                let [a, b, c, d] = [at, at + 1, at + COLUMNS + 2, at + COLUMNS + 1];
                faces += &format!("f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c} {d}/{d}/{d}\n");
            }
        }
    }
    lines + &faces
}

/// A soft image, of which neighbours differ by at most `SLOPE`, also across its edges.
const SIDE: u32 = 64;
const SLOPE: f64 = 12.0;

fn image() -> Vec<u8> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 18 to 238")]
    let wave = |k: u32| ((f64::from(k) / f64::from(SIDE) * TAU).sin() * 110.0 + 128.0) as u8;
    let picture = image::RgbImage::from_fn(SIDE, SIDE, |x, y| image::Rgb([wave(x), wave(y), 90]));
    let mut file = std::io::Cursor::new(vec![]);
    picture.write_to(&mut file, image::ImageFormat::Png).expect("an image");
    file.into_inner()
}

fn folder() -> Folder {
    Folder::with(&[("ball.obj", ball().as_bytes()), ("soft.png", &image()), ("m.obj", TRIANGLE.as_bytes())])
}

/// Runs `alberti bake` into the folder `out`.
fn bake(folder: &Folder, arguments: &[&str]) -> Run {
    let arguments = [arguments, &["--out", "out"]].concat();
    alberti(folder.0.path(), &[OsStr::new("bake")], &arguments)
}

/// The same, which has to succeed, with its report and its file.
fn baked(folder: &Folder, name: &str, arguments: &[&str]) -> (Value, Vec<u8>) {
    let run = bake(folder, &[arguments, &["--json"]].concat());
    assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
    let report = serde_json::from_str(&run.stdout).expect("one line of JSON");
    (report, fs::read(folder.path(&format!("out/{name}.bin"))).expect("the file"))
}

fn number(report: &Value, key: &str) -> f64 {
    report["lost"][key].as_f64().unwrap_or_else(|| panic!("{key} in {report}"))
}

/// The files of the library's example, byte by byte: they are made again by the command that they name.
#[test]
fn the_example_is_what_is_baked() {
    let folder = Folder::with(&[]);
    let run = bake(&folder, &["--scene", "cube"]);
    assert_eq!(run.status, Some(0), "{run:?}");
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../alberti/examples/baked");
    for name in ["cube.rs", "cube.bin"] {
        let [found, kept] =
            [folder.path("out").join(name), example.join(name)].map(|path| fs::read(path).expect("a file"));
        assert!(found == kept, "{name} differs: bake the built-in scene `cube` again");
    }
}

/// Each vertex of the model against the nearest of the file.
#[test]
fn vertices_are_as_near_as_the_report_says() {
    let folder = folder();
    let (report, file) = baked(&folder, "ball", &["ball.obj", "--texture", "soft.png"]);
    let file = Baked::read(&file).expect("a file");
    let mesh = file.parts().next().expect("a part").mesh::<(Normal, Uv)>().expect("normals and coordinates");
    let found: Vec<_> = (0..mesh.vertices()).filter_map(|number| mesh.vertex(number)).collect();
    let (model, ..) = scene(&[folder.path("ball.obj").to_str().expect("text")]).expect("the scene");
    let [place, degrees] = ["place", "normal_degrees"].map(|key| number(&report, key));
    let uv = [0, 1].map(|axis| report["lost"]["uv"][axis].as_f64().expect("a number"));
    let unit = f64::from(file.unit());
    assert!(place <= 0.5001 * unit && unit < 2.0 / 32700.0 && degrees < 0.64, "{report}");
    assert!(uv[0] <= 1.0 / 65536.0 && uv[1] <= 1.0 / 32768.0, "{report}");
    let (mut worst, mut worst_angle) = (0.0_f64, 0.0_f64);
    for vertex in &model.vertices {
        let near = |&(point, (normal, coordinates)): &(alberti::Point3<alberti::Object>, (Vec3, Vec2))| {
            let [dx, dy, dz] =
                [0, 1, 2].map(|axis| f64::from(point.coords[axis]) - f64::from(vertex.position[axis]));
            let far = dx.abs().max(dy.abs()).max(dz.abs());
            let off = [0, 1].map(|axis| (f64::from(coordinates[axis]) - f64::from(vertex.uv[axis])).abs());
            let chord = f64::from((normal - Vec3::from_array(vertex.normal)).length());
            let angle = (2.0 * (chord / 2.0).asin()).to_degrees();
            // Places and coordinates are exact in the file's floats; normals are to 2^-14.
            let slack = 1e-6;
            (far <= place + slack
                && off[0] <= uv[0] + slack
                && off[1] <= uv[1] + slack
                && angle <= degrees + 0.01)
                .then_some((far, angle))
        };
        // The poles have triangles without area, which are left out with vertices of theirs.
        if vertex.position[0].hypot(vertex.position[2]) > 1e-3 {
            let (far, angle) =
                found.iter().find_map(near).unwrap_or_else(|| panic!("no vertex near {vertex:?}"));
            (worst, worst_angle) = (worst.max(far), worst_angle.max(angle));
        }
    }
    // The report's figures are reached: they are no more than what is lost.
    assert!(worst > 0.9 * place && worst_angle > 0.9 * degrees, "{worst} {worst_angle} {report}");
}

/// The file drawn by the library, as a program draws it, against the scene drawn by the command.
#[test]
fn frames_differ_by_no_more_than_the_report_says() {
    let folder = folder();
    let ball = folder.path("ball.obj");
    let soft = folder.path("soft.png");
    let of_scene =
        [ball.to_str().expect("text"), "--texture", soft.to_str().expect("text"), "--size", "160x120"];
    let frame = ["--profile", "reference", "--light", "lamp", "--two-sided", "false"];
    folder.succeeds(&[&of_scene[..], &frame, &["--samples", "1", "--filter", "bilinear"]].concat());
    let right = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
    let (model, camera, _) = scene(&of_scene).expect("the scene");
    assert!(model.lights.is_empty());
    for (format, step) in [
        ("rgba8", 0.5),
        ("rgb888", 0.5),
        ("rgb565", 4.2),
        ("rgb565be", 4.2),
        ("rgb565-pairs", 4.2),
        ("rgb565-alpha", 4.2),
        // Half a step of red and green, a 7th, and of blue, which is 90, to 85.
        ("rgb332", 18.3),
        ("indexed8", 24.0),
    ] {
        let (report, file) = baked(&folder, "ball", &[&of_scene[..], &["--format", format]].concat());
        let file = Baked::read(&file).expect("a file");
        let (mut color, mut depth) = (vec![0; 160 * 120], vec![0.0; 160 * 120]);
        let mut target =
            Target::new(Rgba8888, F32Reversed, 160, 120, &mut color, &mut depth).expect("a target");
        target.clear(Rgba8::new(0x20, 0x24, 0x2c, 255));
        let view = view(&camera).expect("a view");
        for part in file.parts() {
            let mesh = part.mesh::<(Normal, Uv)>().expect("normals and coordinates");
            let texels = part.texture().and_then(|number| file.texture(number)).expect("a texture");
            macro_rules! drawn {
                ($map:expr) => {{
                    let stage = Unlit($map.level(0).sampler(Bilinear, Repeat));
                    let stage = Sunlit::new(stage, Vector3::new(to_light(&camera)), AMBIENT, DIFFUSE);
                    Pass::new(&view, &mesh, stage).cull(Cull::None).draw(&mut target);
                }};
            }
            match texels {
                Texels::Rgba8888(map) => drawn!(map),
                Texels::Rgb8(map) => drawn!(map),
                Texels::Rgb565(map) => drawn!(map),
                Texels::Rgb565Be(map) => drawn!(map),
                Texels::Rgb565Pairs(map) => drawn!(map),
                Texels::Rgb565Alpha(map) => drawn!(map),
                Texels::Rgb332(map) => drawn!(map),
                Texels::Indexed8(map) => drawn!(map),
                other => panic!("{other:?}"),
            }
        }
        // A channel moves with the light by the normal, along the image by coordinates and places, and with the texel.
        let [normal, texels, pixels] = [
            number(&report, "normal_degrees").to_radians(),
            number(&report, "texels"),
            number(&report, "pixels"),
        ];
        // A pixel is less than six texels wide but at the outline, which is left out.
        let most = 255.0 * f64::from(DIFFUSE) * normal + SLOPE * (texels + 6.0 * pixels) + step + 2.0;
        let (mut beyond, mut drawn, mut largest) = (0, 0, 0.0_f64);
        for (&pixel, right) in color.iter().zip(right.pixels()) {
            let found = pixel.to_ne_bytes();
            let off = (0..3).map(|k| f64::from(found[k].abs_diff(right.0[k]))).fold(0.0, f64::max);
            drawn += usize::from(right.0 != [0x20, 0x24, 0x2c]);
            beyond += usize::from(off > most);
            largest = largest.max(if off > most { 0.0 } else { off });
        }
        assert!(drawn > 3000, "{drawn}");
        assert!(beyond <= 20, "{format}: {beyond} pixels are off by more than {most}");
        assert!(largest > 0.0 && number(&report, "frame") <= most, "{report}");
    }
}

#[test]
fn only_what_is_used_is_written() {
    let folder = folder();
    for (arguments, attributes, textures) in [
        (&["ball.obj", "--shading", "unlit"][..], Attributes::NONE, 0),
        (&["ball.obj", "--shading", "vertex-color"], Attributes::COLOR, 0),
        (&["ball.obj"], Attributes::NORMAL, 0),
        (&["ball.obj", "--texture", "soft.png", "--shading", "unlit"], Attributes::UV, 1),
        (&["ball.obj", "--texture", "soft.png"], Attributes::UV | Attributes::NORMAL, 1),
        (
            &["ball.obj", "--normal-map", "soft.png"],
            { Attributes::UV | Attributes::NORMAL | Attributes::TANGENT },
            1,
        ),
        (&["ball.obj", "--texture", "soft.png", "--attributes", "normal"], Attributes::NORMAL, 0),
        (&["ball.obj", "--attributes", "none", "--meshlets", "0"], Attributes::NONE, 0),
    ] {
        let (report, file) = baked(&folder, "ball", arguments);
        let found = Baked::read(&file).expect("a file");
        assert_eq!(found.attributes(), attributes, "{arguments:?}");
        assert_eq!((0..9).take_while(|&number| found.texture(number).is_some()).count(), textures);
        // The items are the file.
        let items = report["items"].as_array().expect("items");
        let bytes: u64 = items.iter().map(|item| item["bytes"].as_u64().expect("bytes")).sum();
        assert_eq!((bytes, report["flash"].as_u64()), (file.len() as u64, Some(bytes)), "{report}");
    }
}

/// The seam of a texture parts vertices only where there is one.
#[test]
fn vertices_that_nothing_parts_are_one() {
    let folder = folder();
    let (with, _) = baked(&folder, "ball", &["ball.obj", "--texture", "soft.png"]);
    let (without, _) = baked(&folder, "ball", &["ball.obj"]);
    let count = |report: &Value| report["vertices"].as_u64();
    // A pole has one vertex, and a row one less.
    assert_eq!(count(&without), Some(((ROWS - 1) * COLUMNS + 2).into()));
    assert!(count(&with) >= Some(((ROWS - 1) * (COLUMNS + 1)).into()), "{with}");
    assert_eq!(with["triangles"].as_u64(), Some((2 * (ROWS - 1) * COLUMNS).into()));
    assert!(with["cache_after"].as_f64() < Some(0.95) && with["cache_after"].as_f64() >= Some(0.5), "{with}");
}

#[test]
fn textures_have_the_format_and_the_size_that_is_asked_for() {
    let folder = folder();
    let of = |arguments: &[&str]| {
        baked(&folder, "ball", &[&["ball.obj", "--texture", "soft.png"][..], arguments].concat())
    };
    for (format, bytes) in [
        ("rgb565", 2 * 64 * 64),
        ("rgb565be", 2 * 64 * 64),
        ("rgb565-pairs", 4 * 64 * 64),
        ("rgb565-alpha", 4 * 64 * 64),
        ("rgb444", 2 * 64 * 64),
        ("rgb332", 64 * 64),
        ("grey8", 64 * 64),
        ("grey4", 64 * 32 + 16 * 4),
        ("grey2", 64 * 16 + 4 * 4),
        ("grey1", 64 * 8 + 2 * 4),
        ("indexed1", 64 * 8 + 2 * 4),
        ("indexed2", 64 * 16 + 4 * 4),
        ("indexed4", 64 * 32 + 16 * 4),
        ("indexed8", 64 * 64 + 256 * 4),
        ("rgb888", 3 * 64 * 64),
        ("rgba8", 4 * 64 * 64),
    ] {
        for dither in ["none", "bayer", "blue-noise"] {
            let (report, file) = of(&["--format", format, "--dither", dither]);
            let items = report["items"].as_array().expect("items");
            let found = items.last().and_then(|item| item["bytes"].as_u64()).expect("a texture");
            assert!(found <= bytes && found > bytes / 2, "{format}: {found}");
            assert!(Baked::read(&file).expect("a file").texture(0).is_some());
        }
    }
    let (_, file) = of(&["--filter", "trilinear", "--texture-size", "20"]);
    let Some(Texels::Rgb565(map)) = Baked::read(&file).expect("a file").texture(0) else { panic!("Rgb565") };
    assert_eq!((map.levels(), map.level(0).width()), (5, 16));
}

/// Pairs have the means of single texels, in every level and over edges, as stages in integers read them.
#[test]
fn pairs_are_read_as_single_texels() {
    let folder = folder();
    let arguments = ["ball.obj", "--texture", "soft.png", "--filter", "trilinear", "--dither", "bayer"];
    let of = |format| baked(&folder, "ball", &[&arguments[..], &["--format", format]].concat()).1;
    let (single, pairs) = (of("rgb565"), of("rgb565-pairs"));
    let (single, pairs) = (Baked::read(&single).expect("a file"), Baked::read(&pairs).expect("a file"));
    let (Some(Texels::Rgb565(single)), Some(Texels::Rgb565Pairs(pairs))) =
        (single.texture(0), pairs.texture(0))
    else {
        panic!("both formats")
    };
    assert_eq!((single.levels(), pairs.levels()), (7, 7));
    for level in 0..7 {
        let single = single.level(level).sampler(Bilinear, Repeat);
        let pairs = pairs.level(level).sampler(Bilinear, Repeat);
        for k in 0..2000_u16 {
            let [u, v] = [f32::from(k) * 0.00317, f32::from(k) * -0.0211];
            assert_eq!(single.packed_lanes(One, u, v), pairs.packed_lanes(One, u, v), "{level}: {u} {v}");
        }
    }
}

/// The constants of a program: their types name the format, and their numbers are the file's bytes.
#[test]
fn sources_have_the_texels_of_files() {
    let folder = folder();
    for (format, kind, bits) in [
        ("rgb565", "alberti::texture::format::Rgb565,", 16),
        ("rgb565be", "alberti::texture::format::InBytes<alberti::texture::format::Rgb565Be>,", 8),
        ("rgb565-pairs", "alberti::texture::format::Rgb565Pairs,", 32),
        ("rgb565-alpha", "alberti::texture::format::Rgb565Alpha,", 32),
        ("rgb444", "alberti::texture::format::Rgba4444,", 16),
        ("rgb332", "alberti::texture::format::Rgb332,", 8),
        ("grey4", "alberti::texture::format::Indexed4<'static>,", 8),
        ("indexed1", "alberti::texture::format::Indexed1<'static>,", 8),
        ("indexed2", "alberti::texture::format::Indexed2<'static>,", 8),
        ("rgb888", "alberti::texture::format::Rgb8,", 8),
    ] {
        let (_, file) = baked(
            &folder,
            "ball",
            &["ball.obj", "--texture", "soft.png", "--format", format, "--dither", "bayer"],
        );
        let source = fs::read_to_string(folder.path("out/ball.rs")).expect("the source");
        assert!(source.contains(kind), "{format}");
        let (_, texels) = source.split_once("static TEXELS_0: ").expect("texels");
        let (_, texels) = texels.split_once(" = [").expect("an array");
        let (texels, rest) = texels.split_once("];").expect("its end");
        let words = |text: &str, of: fn(&str) -> Option<u32>| -> Vec<u32> {
            text.split(|c: char| !c.is_ascii_alphanumeric()).filter_map(of).collect()
        };
        let mut bytes = vec![];
        if let Some((_, palette)) = rest.split_once("static PALETTE_0: ") {
            let colors = words(palette, |word| u32::from_str_radix(word.strip_prefix("0x")?, 16).ok());
            bytes.extend(colors.into_iter().flat_map(u32::to_le_bytes));
        }
        let numbers = words(texels, |word| word.parse().ok());
        bytes.extend(numbers.into_iter().flat_map(|word| word.to_le_bytes().into_iter().take(bits / 8)));
        assert!(bytes.len() > 64 * 8 && file.ends_with(&bytes), "{format}: {} bytes", bytes.len());
    }
}

/// The report's bytes against the type that a program has, in each format of a display.
#[test]
fn memory_is_that_of_the_library() {
    let folder = folder();
    // One vertex and one triangle.
    macro_rules! bytes {
        ($format:ty) => {
            Memory::<$format, D16, (Vec3, Vec2), { 320 * 8 }, 1, 1>::BYTES as u64
        };
    }
    let mut chips = vec![];
    for (format, frame) in [
        ("rgb565", bytes!(Rgb565Be)),
        ("rgba8", bytes!(Rgba8888)),
        ("rgb444", bytes!(color::Rgb444)),
        ("rgb666", bytes!(color::Rgb666)),
        ("rgb888", bytes!(color::Rgb888)),
        ("xrgb8888", bytes!(color::Xrgb8888)),
        ("rgb332", bytes!(color::Rgb332)),
        ("indexed8", bytes!(color::Indexed)),
        ("grey8", bytes!(color::Grey8)),
        ("grey4", bytes!(color::Grey4)),
        ("grey2", bytes!(color::Grey2)),
        ("grey1", bytes!(color::Grey1)),
    ] {
        let of = ["ball.obj", "--texture", "soft.png", "--band", "8", "--color", format];
        let (report, _) = baked(&folder, "ball", &of);
        let [vertices, triangles] =
            ["vertices", "triangles"].map(|key| report[key].as_u64().expect("a number"));
        let slot = size_of::<alberti::Slot<(Vec3, Vec2)>>() as u64;
        let expected = frame + (vertices - 1) * slot + (triangles - 1) * 4;
        assert_eq!(report["ram"].as_u64(), Some(expected), "{report}");
        assert_eq!(report["memory"][0]["name"], format!("colours of two bands, {format}"));
        // Prices are those of one format.
        chips.push(report["chips"].clone());
        assert_eq!(report["chips"], chips[0]);
    }
    for (chip, name) in
        chips[0].as_array().expect("chips").iter().zip(["m0", "m3", "m4f", "m7", "m33", "rv32"])
    {
        assert_eq!(chip["chip"], name);
        assert!(chip["instructions"].as_f64() > Some(1e5));
    }
}
