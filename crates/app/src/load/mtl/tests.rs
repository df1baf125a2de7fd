use super::*;
use crate::options::{Material, Wrap};
use crate::scene::EnvironmentKind;

fn run(text: &[u8]) -> (CheckedMtl, Vec<String>) {
    let (mut checked, mut warnings) = (CheckedMtl::default(), Warnings::default());
    checked.add(text, Path::new("m.mtl"), &mut warnings);
    (checked, warnings.lines().collect())
}

#[test]
fn only_what_is_used_is_passed_on() {
    let (checked, warnings) =
        run(b"newmtl a b\r\n\tKa 0 0 0\n Kd 1 0.5 0 # x\nKd 0.5\nillum 2\nmap_Kd wood 1.png\nTf\n");
    assert_eq!(checked.materials[0].material.color, Some(Color([0.5; 3])));
    let map = checked.materials[0].material.color_map.clone().expect("a map");
    assert_eq!(
        (map.path, map.origin.map(|o| (o.line, o.text))),
        ("wood 1.png".into(), Some((6, "wood 1.png".into())))
    );
    assert_eq!(checked.names, HashMap::from([("a b".to_owned(), 0)]));
    let expected = "m.mtl:7: found `Tf`, expected a statement that is drawn; it is left out";
    assert_eq!(warnings, [expected]);
}

#[test]
fn all_that_is_ignored_is_told_once() {
    let text = b"newmtl a\nTf 1 .9 1\nNi 1\nKa 0 0 0\nmap_Ka x\nKM 1\nnewmtl b\ntf 0 0 0\nbump b\ndisp d\nbump -t 1 c\n\
        Kd spectral k.rfl 2\nKs xyz 1 1 1\n";
    let (_, warnings) = run(text);
    let told = "m.mtl:2: found `Tf`, 2 times; `KM`; `disp` beside `bump`; `-t` of textures; `Kd spectral`; `Ks xyz`, \
        expected statements that are drawn; they are left out";
    assert_eq!(warnings, [told]);
}

/// Statements that say what a surface is without them.
#[test]
fn what_says_nothing_is_not_told() {
    let (_, warnings) = run(b"newmtl a\nTf 1 1 1\nPs 0\nPc 0.0\nPcr 0.03\naniso 0\nanisor 0\ntf 1\n");
    assert_eq!(warnings, [""; 0]);
    let (_, warnings) = run(b"newmtl a\nNs -1.96\nPs 0\nPc 0.5\nnewmtl b\nNs -1.97\nTf 1 x\n");
    let told = "m.mtl:2: found `Ns` below 0, 2 times; `Pc`; `Tf`, expected statements that are drawn; they are left out";
    assert_eq!(warnings, [told]);
}

#[test]
fn of_equal_names_the_last_counts_and_says_so() {
    let (checked, warnings) = run(b"newmtl a\nKd 1 0 0\nnewmtl b\nnewmtl a\nKd 0 1 0\n");
    assert_eq!(
        warnings,
        ["m.mtl:4: found a second material \"a\", expected a name for each; the last of them counts"]
    );
    let named = &checked.materials[checked.names["a"]];
    assert_eq!(named.material.color, Some(Color([0.0, 1.0, 0.0])));
}

#[test]
fn keywords_count_in_any_letters() {
    let text = "newmtl a\nKd 1 0 0\nKs 0 1 0\nNs 9\nd 0.25\nPr 0.5\nPm 0\nillum 2\nmap_Kd A.png\nmap_d D.png\nnorm N\n";
    let lower = text.replace("Kd", "kd").replace("Ks", "ks").replace("Ns", "ns").replace('P', "p");
    let upper = text.replace("newmtl", "NEWMTL").replace("illum", "ILLUM").replace("map_", "MAP_");
    let upper = upper.replace("d 0.25", "D 0.25").replace("norm", "Norm");
    let found = run(text.as_bytes()).0.materials;
    assert!(
        found[0].opacity == Some(0.25) && found[0].alpha_map.is_some() && found[0].roughness == Some(0.5)
    );
    for other in [lower, upper] {
        assert_eq!(run(other.as_bytes()).0.materials, found, "{other}");
    }
}

/// A material's highlight: its colour in red, and its exponent.
fn highlight(text: &str) -> (f32, f32) {
    let drawn = run(format!("newmtl a\nKd 0.5 0.5 0.5\n{text}\n").as_bytes()).0.materials[0].drawn();
    let specular = drawn.specular.map_or(f32::NAN, |Color([red, ..])| red);
    (specular, drawn.shininess.map_or(0.0, |Shininess([_, greatest])| greatest))
}

#[test]
fn highlights_are_those_of_the_file() {
    for (text, expected) in [
        ("", (0.0, 0.0)),
        ("Ks 0 0 0\nNs 90", (0.0, 90.0)),
        ("Ks .5 .5 .5\nNs 90", (0.5, 90.0)),
        ("Ks .5 .5 .5", (0.5, 0.0)),
        ("Ks .5 .5 .5\nNs 90\nillum 2", (0.5, 90.0)),
        ("Ks .5 .5 .5\nNs 90\nillum 1", (0.0, 90.0)),
        ("Ks .5 .5 .5\nNs 0", (0.5, 0.0)),
        ("Ks .5 .5 .5\nNs 2", (0.5, 2.0)),
    ] {
        assert_eq!(highlight(text), expected, "{text}");
    }
    // alpha = 0.25: 2/alpha² - 2 = 30, and 0.04 (30 + 8)/8.
    let (specular, exponent) = highlight("Pr 0.5");
    assert!((specular - 0.19).abs() < 1e-5 && (exponent - 30.0).abs() < 1e-4, "{specular} {exponent}");
    // Metal mirrors in its own colour, as much of that as there is.
    assert!((highlight("Pr 0.9\nPm 1").0 - 0.5 * (1.048_32 + 8.0) / 8.0).abs() < 1e-3);
    assert_eq!(highlight("Ks .5 .5 .5\nNs 90\nPr 1\nPm 0"), (0.5, 90.0));
}

#[test]
fn a_texture_without_a_colour_is_as_bright_as_its_image() {
    let color = |text: &str| run(format!("newmtl a\n{text}\n").as_bytes()).0.materials[0].drawn().color;
    assert_eq!(color("map_Kd a.png"), Some(Color([1.0; 3])));
    // Nor is it meant by what exporters write beside it, unless that has a hue.
    for grey in ["0", ".5", ".8 .8 .8", "0.588 0.589 0.587"] {
        assert_eq!(color(&format!("Kd {grey}\nmap_Kd a.png")), Some(Color([1.0; 3])));
    }
    assert_eq!(color("Kd .5 .51 .5\nmap_Kd a.png"), Some(Color([0.5, 0.51, 0.5])));
    assert_eq!(color("Kd .5 .5 .5"), Some(Color([0.5; 3])));
    assert_eq!(color("Ks 1 1 1"), None);
}

#[test]
fn opacity_comes_before_transparency() {
    for (text, opacity, warned) in [
        ("", 1.0, 0),
        ("d 0.25", 0.25, 0),
        ("Tr 0.75", 0.25, 0),
        ("d 0.5\nTr 0.75", 0.5, 0),
        ("Tr 0.75\nd 0.5", 0.5, 0),
        ("d -halo 0.5", 0.5, 0),
        ("Tr 1", 1.0, 1),
        ("d 2", 1.0, 1),
        ("d 0", 0.0, 1),
    ] {
        let (checked, warnings) = run(format!("newmtl a\n{text}\n").as_bytes());
        assert!((checked.materials[0].opacity() - opacity).abs() < 1e-6, "{text}");
        assert_eq!(warnings.len(), warned, "{text} {warnings:?}");
    }
}

#[test]
fn textures_are_placed() {
    let placed = |text: &str| {
        let (checked, warnings) = run(format!("newmtl a\n{text}\n").as_bytes());
        (checked.materials[0].placed, warnings.len())
    };
    assert_eq!(placed("map_Kd -s 2 3 1 -o .5 .25 0 a.png"), (Some([[2.0, 3.0], [0.5, 0.25]]), 0));
    assert_eq!(placed("map_Kd -s 1 1 1 -o 0 0 0 a.png"), (Some([[1.0; 2], [0.0; 2]]), 0));
    // The texture of `Kd` stays as it is, wherever its line is.
    assert_eq!(placed("map_Kd a\nbump -s 4 4 b\nmap_d -o .5 c"), (Some([[1.0; 2], [0.0; 2]]), 1));
    assert_eq!(placed("bump -s 4 4 b\nmap_Kd a"), (Some([[1.0; 2], [0.0; 2]]), 1));
    assert_eq!(placed("bump -s 4 4 b\ndisp d"), (Some([[4.0; 2], [0.0; 2]]), 1));
    assert_eq!(placed("refl -type sphere b\nbump -s 4 4 b"), (Some([[4.0; 2], [0.0; 2]]), 0));
    assert_eq!(placed("map_Kd -s 2 2 a\nbump -s 2 2 b"), (Some([[2.0, 2.0], [0.0, 0.0]]), 0));
    assert_eq!(placed("map_Kd -s 2 2 a\nbump -s 3 3 b"), (Some([[2.0, 2.0], [0.0, 0.0]]), 1));
}

#[test]
fn ranges_are_those_of_colours_and_heights() {
    let material = |line: &str| {
        let (checked, warnings) = run(format!("newmtl a\n{line}\n").as_bytes());
        (checked.materials[0].material.clone(), warnings.len())
    };
    let color = |line: &str| material(line).0.color_map.and_then(|map| map.range);
    assert_eq!(color("map_Kd -mm 0.25 0.5 a.png"), Some([0.25, 0.5]));
    assert_eq!(color("map_Kd -mm 0 1 a.png"), None);
    for (line, scale) in
        [("", None), ("-mm 0 3", Some(3.0)), ("-bm 2 -mm 0 3", Some(6.0)), ("-bm 2", Some(2.0))]
    {
        assert_eq!(material(&format!("bump {line} a.png")).0.height_scale, scale, "{line}");
    }
    let (normals, warnings) = material("norm -mm 0 0.5 a.png");
    assert_eq!((normals.normal_map.and_then(|map| map.range), warnings), (None, 1));
}

#[test]
fn alpha_is_holes_or_shades() {
    let texels = |alphas: &[u8]| alphas.iter().map(|&alpha| [9, 9, 9, alpha]).collect::<Vec<_>>();
    for (alphas, expected) in [
        (&[255; 20][..], Alpha::Opaque),
        (&[0; 20], Alpha::Opaque),
        (&[250; 20], Alpha::Opaque),
        (&[0, 255, 255, 0], Alpha::Holes),
        (&[100; 20], Alpha::Shades),
        (&[0, 0, 255, 128], Alpha::Shades),
    ] {
        assert_eq!(Alpha::of(&texels(alphas), 2), expected, "{alphas:?}");
    }
    let mut rims = [255; 40];
    rims[..3].copy_from_slice(&[0, 60, 200]);
    assert_eq!(Alpha::of(&texels(&rims), 40), Alpha::Holes);
    // A thirtieth of 3600 texels: as a rim around a hole, and as a square in their midst.
    let mut rim = [255; 3600];
    (0..120).for_each(|k| rim[k * 30] = 128);
    assert_eq!(Alpha::of(&texels(&rim), 60), Alpha::Holes);
    let mut pane = [255; 3600];
    (0..121).for_each(|k| pane[(20 + k / 11) * 60 + 20 + k % 11] = 128);
    assert_eq!(Alpha::of(&texels(&pane), 60), Alpha::Shades);
}

#[test]
fn broken_lines_are_left_out_and_named() {
    for (line, found) in [
        ("Kd 1 2", "found `Kd` with 2 numbers, expected `Kd r g b`"),
        ("Kd", "found `Kd` with 0 numbers"),
        ("Kd 1 x 1", "found \"x\" after `Kd`"),
        ("Kd nan 0 0", "found \"nan\" after `Kd`"),
        ("Kd 1e400 0 0", "found \"1e400\" after `Kd`"),
        ("Ks 1 2", "found `Ks` with 2 numbers"),
        ("Ns", "found `Ns` with 0 numbers, expected `Ns` and a number"),
        ("illum x", "found \"x\" after `illum`"),
        ("map_Kd", "found `map_Kd` without a file"),
        ("bump -bm 2", "found `bump` without a file"),
        ("map_Kd -s 1 1 1", "found `map_Kd` without a file"),
        ("newmtl", "found `newmtl` without a name"),
    ] {
        let (checked, warnings) = run(format!("newmtl a\n{line}\n").as_bytes());
        assert_eq!(checked.materials, [Entry { name: "a".into(), ..Entry::default() }]);
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].starts_with(&format!("m.mtl:2: {found}")), "{warnings:?}");
    }
}

#[test]
fn lines_before_a_name_are_left_out() {
    let (checked, warnings) = run(b"Kd 1 1 1\nnewmtl\nKd 0 0 0\nnewmtl b\n");
    assert_eq!(checked.materials, [Entry { name: "b".into(), ..Entry::default() }]);
    assert_eq!(checked.names, HashMap::from([("b".to_owned(), 0)]));
    // Of the material without a name there is one.
    assert_eq!(warnings.len(), 2);
}

#[test]
fn options_of_textures_are_skipped() {
    let name = |checked: &CheckedMtl| checked.materials[0].material.color_map.clone().map(|map| map.path);
    for (line, warned) in [
        ("-s 1 2 3 a b.png", 0),
        ("-mm 0 1 -o 0.5 a b.png", 0),
        ("-bm 1 a b.png", 1),
        ("-clamp on a b.png", 0),
        ("-clamp off a b.png", 0),
        ("-clamp on -o 1 a b.png", 0),
        ("-mm 0 1 -cc on -blendu on a b.png", 1),
    ] {
        let (checked, warnings) = run(format!("newmtl x\nmap_Kd {line}").as_bytes());
        assert_eq!(name(&checked), Some("a b.png".into()));
        assert_eq!(warnings.len(), warned, "{line} {warnings:?}");
    }
    let (checked, _) = run(b"newmtl x\nmap_Kd -a.png");
    assert_eq!(name(&checked), Some("-a.png".into()));
    let (checked, _) = run(b"newmtl x\nmap_Kd -clamp on a.png");
    assert_eq!(checked.materials[0].material.color_map.as_ref().and_then(|map| map.wrap), Some(Wrap::Clamp));
}

#[test]
fn numbers_out_of_range_are_clamped_and_named() {
    for (line, found) in [
        ("Ns -3", "found `Ns` below 0, expected a statement that is drawn; it is left out"),
        ("Ns 1e9", "found 1000000000 after `Ns`, expected a number from 0 to 65536"),
        ("Ke 2 2 2", "found 2 after `Ke`, expected a number from 0 to 1; it is clamped"),
        ("Ks 0 -1 0", "found -1 after `Ks`, expected a number from 0 to 1"),
        ("bump -bm nan b.png", "found \"nan\" after `-bm`, expected a finite number; the option is left out"),
        ("norm -bm x b.png", "found \"x\" after `-bm`, expected a finite number"),
        (
            "map_Kd -mm x 1 b.png",
            "found \"x\" after `-mm`, expected two finite numbers; the option is left out",
        ),
    ] {
        let (checked, warnings) = run(format!("newmtl a\n{line}\n").as_bytes());
        assert_eq!(warnings.len(), 1, "{line} {warnings:?}");
        assert!(warnings[0].starts_with(&format!("m.mtl:2: {found}")), "{warnings:?}");
        let Material { shininess, specular, emissive, normal_strength, height_scale, .. } =
            &checked.materials[0].material;
        assert!(shininess.iter().flat_map(|n| n.0).all(|n| (0.0..=65536.0).contains(&n)));
        assert!(
            [specular, emissive].into_iter().flatten().flat_map(|c| c.0).all(|x| (0.0..=1.0).contains(&x))
        );
        assert_eq!((normal_strength, height_scale), (&None, &None));
    }
}

#[test]
fn all_maps_are_read() {
    let (checked, warnings) = run(b"newmtl x\nmap_Ks s\nmap_Ns n\nKs .5 1 0\nNs 40\nKe 1\nmap_Ke e\n\
        bump -bm 3 b\nnorm m\nrefl -type sphere r");
    assert!(warnings.is_empty(), "{warnings:?}");
    let found = &checked.materials[0].material;
    assert_eq!(
        (found.specular, found.shininess),
        (Some(Color([0.5, 1.0, 0.0])), Some(Shininess([0.0, 40.0])))
    );
    assert_eq!((found.emissive, found.height_scale), (Some(Color([1.0; 3])), Some(3.0)));
    let maps = [
        &found.specular_map,
        &found.shininess_map,
        &found.emissive_map,
        &found.height_map,
        &found.normal_map,
        &found.environment,
    ];
    let names: Vec<_> =
        maps.iter().map(|map| map.as_ref().expect("a map").path.display().to_string()).collect();
    assert_eq!(names, ["s", "n", "e", "b", "m", "r"]);
    assert_eq!(found.environment_kind, Some(EnvironmentKind::Sphere));
}

#[test]
fn sides_of_a_cube_are_left_out() {
    let (checked, warnings) = run(b"newmtl x\nrefl -type cube_top t.png\n");
    assert_eq!(checked.materials[0].material.environment, None);
    assert!(warnings[0].starts_with("m.mtl:2: found `refl` of type \"cube_top\""), "{warnings:?}");
}

#[test]
fn binary_libraries_are_left_out_whole() {
    let (checked, warnings) = run(b"newmtl\0");
    assert!(checked.materials.is_empty() && checked.names.is_empty());
    assert!(warnings[0].starts_with("m.mtl: found a binary file"));
}

/// Blender's colours are amounts of light: 0.2140411 is half of what sRGB has (IEC 61966-2-1).
#[test]
fn colours_of_blender_are_light() {
    let text = b"newmtl a\nKd 0.2140411 0 1\nKs 0.5 0.5 0.5\nKe 0.0030353 0.5 0.05\n";
    let (other, _) = run(text);
    let (own, warnings) = run(&[&b"# Blender 3.4.1 MTL File: 'x.blend'\n"[..], text].concat());
    assert_eq!(warnings, [""; 0]);
    let close = |a: Option<Color>, b: [f32; 3]| {
        a.is_some_and(|Color(a)| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5))
    };
    let [other, own] = [other, own].map(|checked| checked.materials[0].material.clone());
    assert!(close(other.color, [0.214_041_1, 0.0, 1.0]), "{other:?}");
    assert!(close(own.color, [0.5, 0.0, 1.0]), "{own:?}");
    // 10, 188 and 63 of 255.
    assert!(close(own.emissive, [0.039_215_6, 0.735_356_9, 0.247_801_2]), "{own:?}");
    assert_eq!(own.specular, other.specular);
}
