//! Tests of scene files: what comes from them, and ([`errors`]) what is refused.

use super::*;
use crate::options::values::Size;
use crate::options::{CameraTable, Filter, Probes, ProjectorTable, RenderTable, Shading};
use crate::scene::Glow;
use crate::scene::{EnvironmentKind, Light, NormalSpace, Relief};
use clap::{Args as _, Command, FromArgMatches as _};
use serde::de::DeserializeOwned;
use std::fmt::Debug;
use std::fs;

mod errors;

const MINIMAL: &str = "[[object]]\nsurface = \"plane\"\n";

/// The words of a command line.
fn words(words: &str) -> ArgMatches {
    RenderArgs::augment_args(Command::new("render"))
        .no_binary_name(true)
        .get_matches_from(words.split_whitespace())
}

/// Writes the files and reads the first.
fn read(files: &[(&str, &[u8])]) -> Result<(tempfile::TempDir, SceneFile, RenderArgs), Error> {
    let folder = tempfile::tempdir().expect("a folder for the test");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("a file for the test");
    }
    let (scene, arguments) = SceneFile::read(&folder.path().join(files[0].0), &words(""), 0.0)?;
    crate::cli::partners::check(&arguments).map_err(|error| scene.relocate(error))?;
    Ok((folder, scene, arguments))
}

fn build(files: &[(&str, &[u8])]) -> Result<Model, Error> {
    let (_folder, scene, arguments) = read(files)?;
    let mut warnings = Warnings::default();
    let model =
        scene.build(scene.gather(&Material::default(), &arguments, &mut warnings, &mut |_, _| ())?)?;
    assert_eq!(warnings.lines().collect::<Vec<_>>(), Vec::<String>::new());
    Ok(model)
}

fn png(texels: &[[u8; 3]]) -> Vec<u8> {
    image(texels.len(), texels)
}

fn image(width: usize, texels: &[[u8; 3]]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let [width, height] =
        [width, texels.len() / width].map(|side| u32::try_from(side).expect("a small image"));
    image::RgbImage::from_raw(width, height, texels.concat())
        .expect("an image")
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("encoding");
    bytes.into_inner()
}

/// A roof whose two sides share an edge: four vertices where it is smooth, six where it is flat.
#[test]
fn normals_are_those_of_the_command_line_then_of_the_object_then_of_all() {
    const ROOF: &str = "v 0 0 0\nv 1 0 0\nv 1 0.2 1\nv 1 0 2\nf 1 3 2\nf 1 4 3\n";
    const OBJECTS: &str = "[[object]]\nmodel = \"roof.obj\"\n\
         [[object]]\nmodel = \"roof.obj\"\nnormals = \"smooth\"\n";
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("roof.obj"), ROOF).unwrap();
    let vertices = |all: &str, given: &str| {
        let path = folder.path().join("s.toml");
        fs::write(&path, format!("{all}{OBJECTS}")).unwrap();
        let given = words(given);
        let (scene, mut arguments) = SceneFile::read(&path, &given, 0.0).unwrap();
        arguments.update_from_arg_matches(&given).unwrap();
        let warnings = &mut Warnings::default();
        let gathered = scene.gather(&Material::default(), &arguments, warnings, &mut |_, _| ()).unwrap();
        let model = scene.build(gathered).unwrap();
        model.vertices.len()
    };
    let flat = "[render]\nnormals = \"flat\"\n";
    assert_eq!(vertices("", ""), 4 + 4);
    assert_eq!(vertices(flat, ""), 6 + 4);
    assert_eq!(vertices("", "--normals flat"), 6 + 6);
    assert_eq!(vertices(flat, "--normals smooth"), 4 + 4);
}

#[test]
fn options_are_filled_in_and_the_command_line_comes_first() {
    let text = "size = [320, 200]\nbackground = \"102030\"\noutput = \"out.png\"\n\
         [camera]\neye = [1, 2.5, 3]\nfov = 30\n\
         [render]\nshading = \"blinn\"\nfilter = \"anisotropic:8\"\ncolor-format = \"rgb565\"\n\
         [[object]]\nsurface = \"sphere\"\n";
    let (folder, _, arguments) = read(&[("s.toml", text.as_bytes())]).unwrap();
    let RenderArgs { camera, render, .. } = arguments;
    assert_eq!((render.size, camera.eye), (Some(Size(320, 200)), Some([1.0, 2.5, 3.0].into())));
    assert_eq!(render.background.and_then(|background| background.flat()), Some([0x10, 0x20, 0x30]));
    assert_eq!(render.output, Some(folder.path().join("out.png")));
    assert_eq!((camera.fov, render.shading), (Some(30.0.into()), Some(Shading::Blinn)));
    assert_eq!(render.filter, Some(Filter::Anisotropic(Probes::Eight)));
    assert_eq!(render.color_format, Some(crate::options::ColorFormat::Rgb565));
    let given = words("--fov 50 --shading unlit");
    let (scene, mut filled) = SceneFile::read(&folder.path().join("s.toml"), &given, 0.0).unwrap();
    filled.update_from_arg_matches(&given).unwrap();
    assert_eq!((filled.camera.fov, filled.render.shading), (Some(50.0.into()), Some(Shading::Unlit)));
    assert_eq!(filled.render.size, Some(Size(320, 200)));
    // An error of the command line is not the file's fault.
    let error = || Error::new("a", "b");
    assert_eq!(scene.relocate(error().place("--fov")), error().place("--fov"));
    let moved = scene.relocate(error().place("--eye")).to_string();
    assert!(moved.ends_with("s.toml:5: camera.eye: found a, expected b"), "{moved}");
    // And it speaks the file's language, of options that the file has not given as well.
    let error = Error::new("it without --projector", "--projection parallel");
    let moved =
        scene.relocate(error.place("--eye").hint("move --eye or --target, or -o (--far 3)")).to_string();
    let wanted = "found it without projector.image, expected camera.projection parallel; \
                  move camera.eye or camera.target, or output (camera.far 3)";
    assert!(moved.ends_with(wanted), "{moved}");
    let error = || Error::new("a", "b");
    let moved = scene.relocate(error().place("--up")).to_string();
    assert!(moved.ends_with("s.toml:5: camera.eye: found a, expected b"), "{moved}");
}

#[test]
fn materials_lights_and_places_arrive() {
    let text = "[[object]]\nsurface = \"plane\"\nmaterial = \"all\"\nposition = [0, 5, 0]\nscale = 2\n\
        rotation = [90, 0, 0]\n\
        [material.all]\ncolor = \"ff0000\"\ncolor-map = { file = \"a.png\", filter = \"nearest\", wrap = \"mirror\" }\n\
        normal-map = \"a.png\"\nnormal-space = \"object\"\nnormal-strength = 2\n\
        height-map = \"b.png\"\nrelief = \"steep\"\nheight-range = [-0.1, 0]\nwetness-map = \"a.png\"\n\
        shininess = [2, 64]\nshininess-map = \"b.png\"\nspecular = \"ffffff\"\nemissive-map = \"a.png\"\n\
        environment = \"c.png\"\nenvironment-kind = \"cube\"\nuv-scale = [3, 4]\nwrap = \"clamp\"\n\
        [ambient]\nintensity = 0.25\n\
        [[light]]\nkind = \"directional\"\ndirection = [0, -2, 0]\n\
        [[light]]\nkind = \"point\"\nposition = [1, 2, 3]\ncolor = \"00ff00\"\nintensity = 2\nrange = 10\n\
        [[light]]\nkind = \"spot\"\nposition = [0, 4, 0]\ntarget = [0, 0, 0]\nangle = [10, 40]\n";
    let (a, b) = (png(&[[1, 2, 3]]), png(&[[0, 0, 0], [255, 255, 255]]));
    let c = image(1, &[[7; 3]; 6]);
    let model = build(&[("s.toml", text.as_bytes()), ("a.png", &a), ("b.png", &b), ("c.png", &c)]).unwrap();
    // One of them is of highlights, which fade where exponents are below 8.
    assert_eq!((model.textures.len(), model.heights.len()), (4, 1));
    assert_eq!(model.heights[0].heights, [0, 65535]);
    let part = &model.parts[0];
    assert_eq!(
        (part.diffuse, part.texture, part.detail.filter),
        ([1.0, 0.0, 0.0], Some(0), Some(Filter::Nearest))
    );
    let detail = &part.detail;
    let normal = detail.normal.unwrap();
    assert_eq!(
        (normal.map.image, normal.space, normal.strength.to_bits()),
        (0, NormalSpace::Object, 2.0_f32.to_bits())
    );
    assert_eq!(normal.axes, [[0.5, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, -0.5, 0.0]]);
    assert_eq!(
        (detail.wrap, normal.map.wrap),
        (Some(crate::options::Wrap::Mirror), Some(crate::options::Wrap::Clamp))
    );
    let height = detail.height.unwrap();
    assert_eq!((height.relief, height.range), (Relief::Steep, [-0.2, 0.0]));
    // Four units long and the texture three and four times on them.
    assert!((height.extent[0] - 4.0 / 3.0).abs() < 1e-6 && (height.extent[1] - 1.0).abs() < 1e-6);
    assert_eq!((detail.wetness.to_bits(), detail.shininess), (1.0_f32.to_bits(), [2.0, 64.0]));
    assert_eq!((detail.specular, detail.emissive), ([1.0; 3], [1.0; 3]));
    let environment = detail.environment.unwrap();
    assert_eq!((model.textures[environment.image].height, environment.kind), (6, EnvironmentKind::Cube));
    assert_eq!(detail.reflection.to_bits(), 0.5_f32.to_bits());
    // From above, twice as large, and upright.
    let corners: Vec<_> = model.vertices.iter().map(|v| v.position).collect();
    assert_eq!(corners, [[-2.0, 3.0, 0.0], [2.0, 3.0, 0.0], [-2.0, 7.0, 0.0], [2.0, 7.0, 0.0]]);
    assert!(model.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0] && v.tangent == [1.0, 0.0, 0.0, 1.0]));
    assert_eq!(model.ambient, Some(Glow { color: [1.0; 3], intensity: 0.25 }));
    let color = Glow { color: [1.0; 3], intensity: 1.0 };
    assert_eq!(
        model.lights,
        [
            Light::Directional { to_light: [0.0, 1.0, 0.0], color },
            Light::Point {
                position: [1.0, 2.0, 3.0],
                color: Glow { color: [0.0, 1.0, 0.0], intensity: 2.0 },
                range: 10.0
            },
            Light::Spot {
                position: [0.0, 4.0, 0.0],
                direction: [0.0, -1.0, 0.0],
                color,
                range: f32::INFINITY,
                inner: 10.0,
                outer: 40.0
            },
        ]
    );
}

#[test]
fn another_map_is_used_as_the_one_before() {
    let text = format!(
        "{MINIMAL}material = \"a\"\n[material.a]\nheight-map = {{ file = \"a.png\", wrap = \"mirror\" }}\n\
         relief = \"steep\"\nheight-range = [-0.25, 0]\nnormal-map = \"a.png\"\nnormal-space = \"object\"\n\
         normal-strength = 2\nenvironment = \"a.png\"\nenvironment-kind = \"sphere\"\nreflection = 0.25\n"
    );
    let (a, b) = (png(&[[1, 1, 1]]), png(&[[2, 2, 2]]));
    let (folder, scene, arguments) =
        read(&[("s.toml", text.as_bytes()), ("a.png", &a), ("b.png", &b)]).unwrap();
    let map = Some(crate::options::MapFile::given(&folder.path().join("b.png")));
    let over = Material {
        normal_map: map.clone(),
        height_map: map.clone(),
        environment: map,
        ..Material::default()
    };
    let build = |over: &Material| {
        let gathered = scene.gather(over, &arguments, &mut Warnings::default(), &mut |_, _| ()).unwrap();
        let model = scene.build(gathered).unwrap();
        (model.parts[0].detail.clone(), model.textures[0].texels[0][0], model.heights[0].heights[0])
    };
    let (before, after) = (build(&Material::default()), build(&over));
    assert_eq!((before.1, before.2, after.1, after.2), (1, 257, 2, 514));
    assert_eq!(before.0, after.0);
    let steeper =
        build(&Material { height_range: Some([0.0, 1.0].into()), normal_strength: Some(3.0.into()), ..over })
            .0;
    assert_eq!(steeper.height.map(|height| (height.relief, height.range)), Some((Relief::Steep, [0.0, 1.0])));
    assert_eq!(steeper.normal.map(|n| (n.space, n.strength)), Some((NormalSpace::Object, 3.0)));
}

#[test]
fn surfaces_without_a_material_are_grey() {
    let model = build(&[("s.toml", MINIMAL.as_bytes())]).unwrap();
    assert_eq!(
        (model.parts[0].diffuse, model.ambient, model.lights.len()),
        (crate::load::obj::DEFAULT_DIFFUSE, None, 0)
    );
}

#[test]
fn objects_come_together() {
    let obj = b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";
    let mtl = b"newmtl m\nKd 0 0 1\nmap_Kd b.png\nnorm a.png\n";
    let text = "[[object]]\nsurface = \"plane\"\nmaterial = \"a\"\n\
        [[object]]\nmodel = \"m.obj\"\nposition = [0, 9, 0]\n\
        [[object]]\nmodel = \"m.obj\"\nmaterial = \"a\"\n[material.a]\ncolor-map = \"a.png\"\n";
    let (a, b) = (png(&[[1, 1, 1]]), png(&[[2, 2, 2]]));
    let files =
        [("s.toml", text.as_bytes()), ("m.obj", &obj[..]), ("m.mtl", mtl), ("a.png", &a), ("b.png", &b)];
    let model = build(&files).unwrap();
    assert_eq!(model.parts.len(), 3);
    let texel = |k: usize| model.parts[k].texture.map(|t| model.textures[t].texels[0][0]);
    assert_eq!([0, 1, 2].map(texel), [Some(1), Some(2), Some(1)]);
    let normal = model.parts[1].detail.normal.unwrap();
    assert_eq!(model.textures[normal.map.image].texels[0][0], 1);
    assert_eq!((model.parts[1].diffuse, model.parts[2].diffuse), ([0.0, 0.0, 1.0], [1.0; 3]));
    assert_eq!(model.parts[2].detail.normal, None);
    let at = |k: usize| model.parts[k].triangles[0].map(|i| model.vertices[i as usize].position);
    assert_eq!(at(1), [[0.0, 9.0, 0.0], [1.0, 9.0, 0.0], [0.0, 10.0, 0.0]]);
    // Only where a map needs it.
    let tangent = |k: usize| model.vertices[model.parts[k].triangles[0][0] as usize].tangent;
    assert_eq!((tangent(1), tangent(2)), ([1.0, 0.0, 0.0, 1.0], [0.0; 4]));
}

#[test]
fn displaced_surfaces_have_a_vertex_for_each_texel_and_no_hole() {
    let text = "[[object]]\nsurface = \"torus\"\nsegments = [3, 3]\nmaterial = \"a\"\n\
        [material.a]\nheight-map = \"h.png\"\nrelief = \"displacement\"\nheight-range = [0, 0.1]\n";
    let rows: Vec<_> = (0..20_u8).map(|x| [x.wrapping_mul(97); 3]).collect();
    let model = build(&[("s.toml", text.as_bytes()), ("h.png", &png(&rows))]).unwrap();
    assert_eq!(model.parts[0].triangles.len(), 2 * 20 * 3);
    let mut edges = std::collections::HashMap::new();
    for triangle in &model.parts[0].triangles {
        let at = triangle.map(|i| model.vertices[i as usize].position.map(|x| (x + 0.0).to_bits()));
        for (a, b) in [(at[0], at[1]), (at[1], at[2]), (at[2], at[0])] {
            *edges.entry([a.min(b), a.max(b)]).or_insert(0) += if a < b { 1 } else { -1 };
        }
    }
    assert_eq!(edges.len(), 3 * 20 * 3);
    assert!(edges.values().all(|&n| n == 0));
}

#[test]
fn the_example_of_the_readme_is_a_scene() {
    let readme = include_str!("../../../README.md");
    let example =
        readme.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    let (_folder, scene, arguments) = read(&[("s.toml", example.as_bytes())]).expect(example);
    assert_eq!((scene.file.object.len(), scene.file.material.len(), scene.file.light.len()), (2, 2, 2));
    let RenderTable { size, shading, .. } = arguments.render;
    assert_eq!((size, shading), (Some(Size(640, 480)), Some(Shading::Blinn)));
}

/// The keys of a table, as it lists them itself.
fn keys<T: DeserializeOwned + Debug>() -> Vec<String> {
    let error = toml::from_str::<T>("no-such-key = 1").expect_err("an unknown key");
    error.message().split('`').skip(3).step_by(2).map(str::to_owned).collect()
}

#[test]
fn the_readme_has_every_key() {
    let readme = include_str!("../../../README.md");
    let all = [
        keys::<File>(),
        keys::<CameraTable>(),
        keys::<ProjectorTable>(),
        keys::<RenderTable>(),
        keys::<tables::Object>(),
        keys::<Material>(),
        keys::<tables::Ambient>(),
        keys::<tables::Light>(),
    ]
    .concat();
    for key in &all {
        let (key_there, table_there) = (format!("`{key}`"), format!("[{key}"));
        assert!(readme.contains(&key_there) || readme.contains(&table_there), "{key}");
    }
    assert!(all.len() > 60, "{all:?}");
}
