use super::*;
use crate::options::Wrap;
use crate::scene::EnvironmentKind;

fn run(text: &[u8]) -> (CheckedMtl, Vec<String>) {
    let (mut checked, mut warnings) = (CheckedMtl::default(), Warnings::default());
    checked.add(text, Path::new("m.mtl"), &mut warnings).expect("numbers");
    (checked, warnings.lines().collect())
}

#[test]
fn only_what_is_used_is_passed_on() {
    let (checked, warnings) =
        run(b"newmtl a b\r\n\tKa 0 0 0\n Kd 1 0.5 0 # x\nKd 0.5\nillum 2\nmap_Kd wood 1.png\nTf\n");
    assert_eq!(checked.materials[0].color, Some(Color([0.5; 3])));
    let map = checked.materials[0].color_map.clone().expect("a map");
    assert_eq!(
        (map.path, map.origin.map(|o| (o.line, o.text))),
        ("wood 1.png".into(), Some((6, "wood 1.png".into())))
    );
    assert_eq!(checked.names, HashMap::from([("a b".to_owned(), 0)]));
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn numbers_that_are_none_or_too_few_are_errors() {
    for (line, found) in [
        ("Kd 1 2", "found `Kd` with 2 numbers, expected `Kd r g b`"),
        ("Kd", "found `Kd` with 0 numbers"),
        ("Kd 1 x 1", "found \"x\" after `Kd`"),
        ("Kd nan 0 0", "found \"nan\" after `Kd`"),
        ("Kd 1e400 0 0", "found \"1e400\" after `Kd`"),
    ] {
        let text = format!("newmtl a\n{line}\n");
        let (mut checked, mut warnings) = (CheckedMtl::default(), Warnings::default());
        let error = checked.add(text.as_bytes(), Path::new("m.mtl"), &mut warnings).expect_err(line);
        assert!(error.to_string().starts_with(&format!("m.mtl:2: {found}")), "{error}");
    }
}

#[test]
fn broken_lines_are_left_out_and_named() {
    for (line, found) in [
        ("Ks 1 2", "found `Ks` with 2 numbers"),
        ("Ns", "found `Ns` with 0 numbers, expected `Ns` and a number"),
        ("illum x", "found \"x\" after `illum`"),
        ("map_Kd", "found `map_Kd` without a file"),
        ("bump -bm 2", "found `bump` without a file"),
        ("map_Kd -s 1 1 1", "found `map_Kd` without a file"),
        ("newmtl", "found `newmtl` without a name"),
    ] {
        let (checked, warnings) = run(format!("newmtl a\n{line}\n").as_bytes());
        assert_eq!(checked.materials, [Material::default()]);
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].starts_with(&format!("m.mtl:2: {found}")), "{warnings:?}");
    }
}

#[test]
fn lines_before_a_name_are_left_out() {
    let (checked, warnings) = run(b"Kd 1 1 1\nnewmtl\nKd 0 0 0\nnewmtl b\n");
    assert_eq!(checked.materials, [Material::default()]);
    assert_eq!(checked.names, HashMap::from([("b".to_owned(), 0)]));
    assert_eq!(warnings.len(), 3);
}

#[test]
fn options_of_textures_are_skipped() {
    let name = |checked: &CheckedMtl| checked.materials[0].color_map.clone().map(|map| map.path);
    for (line, warned) in [
        ("-s 1 2 3 a b.png", 1),
        ("-mm 0 1 -o 0.5 a b.png", 1),
        ("-bm 1 a b.png", 1),
        ("-clamp on a b.png", 0),
        ("-clamp off a b.png", 0),
        ("-clamp on -o 1 a b.png", 1),
    ] {
        let (checked, warnings) = run(format!("newmtl x\nmap_Kd {line}").as_bytes());
        assert_eq!(name(&checked), Some("a b.png".into()));
        assert_eq!(warnings.len(), warned, "{line} {warnings:?}");
    }
    let (checked, _) = run(b"newmtl x\nmap_Kd -a.png");
    assert_eq!(name(&checked), Some("-a.png".into()));
    let (checked, _) = run(b"newmtl x\nmap_Kd -clamp on a.png");
    assert_eq!(checked.materials[0].color_map.as_ref().and_then(|map| map.wrap), Some(Wrap::Clamp));
}

#[test]
fn numbers_out_of_range_are_clamped_and_named() {
    for (line, found) in [
        ("Ns -3", "found -3 after `Ns`, expected a number from 0 to 65536; it is clamped"),
        ("Ns 1e9", "found 1000000000 after `Ns`, expected a number from 0 to 65536"),
        ("Ke 2 2 2", "found 2 after `Ke`, expected a number from 0 to 1; it is clamped"),
        ("Ks 0 -1 0", "found -1 after `Ks`, expected a number from 0 to 1"),
        ("bump -bm nan b.png", "found \"nan\" after `-bm`, expected a finite number; the option is left out"),
        ("norm -bm x b.png", "found \"x\" after `-bm`, expected a finite number"),
    ] {
        let (checked, warnings) = run(format!("newmtl a\n{line}\n").as_bytes());
        assert_eq!(warnings.len(), 1, "{line} {warnings:?}");
        assert!(warnings[0].starts_with(&format!("m.mtl:2: {found}")), "{warnings:?}");
        let Material { shininess, specular, emissive, normal_strength, height_scale, .. } =
            &checked.materials[0];
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
    let found = &checked.materials[0];
    assert_eq!(
        (found.specular, found.shininess),
        (Some(Color([0.5, 1.0, 0.0])), Some(Shininess([1.0, 40.0])))
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
    assert_eq!(checked.materials[0].environment, None);
    assert!(warnings[0].starts_with("m.mtl:2: found `refl` of type \"cube_top\""), "{warnings:?}");
}

#[test]
fn binary_libraries_are_left_out_whole() {
    let (checked, warnings) = run(b"newmtl\0");
    assert!(checked.materials.is_empty() && checked.names.is_empty());
    assert!(warnings[0].starts_with("m.mtl: found a binary file"));
}
