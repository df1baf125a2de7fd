//! Tests of messages: the line, the key, what was found and what was expected.

use super::{MINIMAL, build, png};

/// The message without the folder.
fn refused(text: &str) -> String {
    let image = png(&[[1, 2, 3]]);
    let broken = b"v 0 0 0\nf 1 2 3\n";
    let error = build(&[("s.toml", text.as_bytes()), ("a.png", &image), ("b.obj", broken)]).expect_err(text);
    let message = error.to_string();
    let start =
        message.find("s.toml").or_else(|| message.find("b.obj:")).unwrap_or_else(|| panic!("{message}"));
    message[start..].to_owned()
}

#[test]
fn kinds_of_values_have_the_words_of_toml() {
    let with = |text: &str| format!("{text}{MINIMAL}");
    for (text, wanted) in [
        ("object = 3\n", "s.toml:1: object: found integer 3, expected tables under [[object]]"),
        (
            "[object]\nsurface = \"plane\"\n",
            "s.toml:1: object: found a table, expected tables under [[object]]",
        ),
        (
            "[object]\nsurface = \"plane\"\n[object]\n",
            "s.toml:3: object: found a key for the second time, expected it once; of tables",
        ),
        (&with("size = [640, 48 0]\n"), "s.toml:1: size: found \"48 0\", expected a value; text has quotes"),
        (
            &with("background = 'red\n"),
            "s.toml:1: background: found text without its closing quotes, expected these",
        ),
        (&with("samples = 4\n"), "s.toml:1: samples: found the unknown key \"samples\", expected one of"),
        (&with("[light]\n"), "s.toml:1: light: found a table, expected tables under [[light]]"),
        (&with("[[camera]]\n"), "s.toml:1: camera: found an array, expected a table, [camera]"),
        (&with("camera = [1]\n"), "s.toml:1: camera: found an array, expected a table, [camera]"),
        (&with("[[material.a]]\n"), "s.toml:1: material.a: found an array, expected a table, [material.a]"),
        (
            &with("background = [1]\n"),
            "s.toml:1: background: found an array, expected text in quotes: hexadecimal digits",
        ),
        (&with("[camera]\nfov = 1979-05-27\n"), "s.toml:2: camera.fov: found a date or a time, expected a"),
        (
            &with("[camera]\nfov = { x = 1 }\n"),
            "s.toml:2: camera.fov: found a table, expected a finite number",
        ),
        (
            &with("[render]\ntwo-sided = 1\n"),
            "s.toml:2: render.two-sided: found integer 1, expected true or false",
        ),
        (
            &with("[render]\nground = Yes\n"),
            "s.toml:2: render.ground: found \"Yes\", expected a value; what is so is true, and what is not is false",
        ),
        (
            &with("[material.a]\nshinines = 80\n"),
            "s.toml:2: material.a.shinines: found the unknown key \"shinines\", expected one that is known there; did",
        ),
    ] {
        let message = refused(text);
        assert!(message.starts_with(wanted), "{message}");
    }
}

#[test]
fn errors_name_line_and_key() {
    let with = |text: &str| format!("{MINIMAL}{text}");
    for (text, wanted) in [
        ("", "s.toml: found no [[object]], expected at least one; see alberti help"),
        ("size = [1,", "s.toml:1: size: found unclosed array, expected ]"),
        ("a\n", "s.toml:1: found "),
        ("[camera\n", "s.toml:1: camera: found unclosed table, expected ]"),
        ("[camera]\nfov = 1\nfov = 2\n", "s.toml:3: fov: found a key for the second time, expected it once"),
        (
            &with("[camera]\nfow = 40\n"),
            "s.toml:4: camera.fow: found the unknown key \"fow\", expected one that is known there; did you mean fov?",
        ),
        (
            &with("[camera]\n\n\nfov = \"wide\"\n"),
            "s.toml:6: camera.fov: found string \"wide\", expected a finite number",
        ),
        (
            &with("[camera]\neye = [1, 2]\n"),
            "s.toml:4: camera.eye: found 2 numbers in brackets, expected three finite numbers in brackets",
        ),
        (&with("[camera]\neye = [1, nan, 2]\n"), "s.toml:4: camera.eye: found NaN, expected a finite number"),
        (
            &with("[camera]\neye = 5\n"),
            "s.toml:4: camera.eye: found 5, expected three finite numbers in brackets",
        ),
        (
            &with("[camera]\nview-height = 5\n"),
            "s.toml:4: camera.view-height: found it without camera.projection parallel",
        ),
        (
            &with("[camera]\nprojection = \"flat\"\n"),
            "s.toml:4: camera.projection: found \"flat\", expected one of perspective, parallel",
        ),
        (
            &format!("size = [0, 5]\n{MINIMAL}"),
            "s.toml:1: size: found 0, expected a whole number from 1 to 16384",
        ),
        (
            &format!("size = [1.5, 5]\n{MINIMAL}"),
            "s.toml:1: size: found 1.5, expected a whole number from 1 to 16384",
        ),
        (
            &format!("background = \"reddish\"\n{MINIMAL}"),
            "s.toml:1: background: found \"reddish\", expected hexadecimal digits",
        ),
        (
            &format!("size = [1, 1]\n{MINIMAL}[render]\nsize = [1, 1]\n"),
            "s.toml:5: render.size: found it at the top of the file as well",
        ),
        (
            &with("[render]\nshading = \"shiny\"\n"),
            "s.toml:4: render.shading: found \"shiny\", expected one of unlit, vertex-color, lambert",
        ),
        (
            &with("[render]\nfilter = \"cubic\"\n"),
            "s.toml:4: render.filter: found \"cubic\", expected nearest, bilinear, trilinear or",
        ),
        (
            &with("[render]\ndepth = 3\n"),
            "s.toml:4: render.depth: found integer 3, expected text in quotes: one of f32",
        ),
        (
            &with("[projector]\neye = [1, 2, 3]\n"),
            "s.toml:4: projector.eye: found it without projector.image and projector.target",
        ),
        (
            "[[object]]\nmodel = \"no.obj\"\n",
            "s.toml:2: object.model: found no such file for the model \"no.obj\", expected",
        ),
        ("[[object]]\nmodel = \"b.obj\"\n", "b.obj:2: found vertex index 2, expected 1 to 1"),
        ("[[object]]\nposition = [1, 2, 3]\n", "s.toml:1: object: found an object without model and surface"),
        (
            "[[object]]\nmodel = \"b.obj\"\nsurface = \"plane\"\n",
            "s.toml:3: object.surface: found a model as well",
        ),
        (
            "[[object]]\nsurface = \"cone\"\n",
            "s.toml:2: object.surface: found \"cone\", expected one of plane, sphere, torus, cylinder",
        ),
        (
            &with("radius = 1\n"),
            "s.toml:3: object.radius: found a key that has no use here, expected a sphere or a cylinder",
        ),
        (
            &with("normals = \"flat\"\n"),
            "s.toml:3: object.normals: found a key that has no use here, expected a model",
        ),
        (
            &with("segments = [9000, 9000]\n"),
            "s.toml:3: object.segments: found 81000000 cells, expected at most 1048576",
        ),
        (&with("scale = 0\n"), "s.toml:3: object.scale: found 0, expected a number, not 0,"),
        (&with("scale = [1, 0, 1]\n"), "s.toml:3: object.scale: found 0, expected a number, not 0,"),
        (
            &with("size = [1e9, 1]\n"),
            "s.toml:3: object.size: found 1000000000, expected a number from 1e-6 to 1e6",
        ),
        (
            &with("material = \"stone\"\n"),
            "s.toml:3: object.material: found the unknown material \"stone\", expected a table [material.stone]",
        ),
        (
            &with("material = \"stone\"\n[material.stome]\n"),
            "s.toml:3: object.material: found the unknown material \"stone\", expected one of stome",
        ),
        (
            &with("[material.a]\ncolour = \"ffffff\"\n"),
            "s.toml:4: material.a.colour: found the unknown key \"colour\", expected one that is known there; did you mean color?",
        ),
        (
            &with("[[light]]\nkind = \"directional\"\ndirection = [0, -1, 0]\nposition = [1, 2, 3]\n"),
            "s.toml:6: light.position: found a position and a direction, expected one of both",
        ),
        (
            &with("[ambient\n[[light]]\nkind = \"point\"\n"),
            "s.toml:3: ambient: found unclosed table, expected ]",
        ),
        (
            &with("[material.a]\nnormal-space = \"object\"\n"),
            "s.toml:4: material.a.normal-space: found it without normal-map, expected normal-map as well",
        ),
        (
            &with("[material.a]\nrelief = \"bump\"\n"),
            "s.toml:4: material.a.relief: found it without height-map",
        ),
        (
            &with("[material.a]\nheight-range = [0, 1]\n"),
            "s.toml:4: material.a.height-range: found it without height-map",
        ),
        (
            &with("[material.a]\nreflection = 0.5\n"),
            "s.toml:4: material.a.reflection: found it without environment",
        ),
        (
            &with("[material.a]\nwetness = 1.5\n"),
            "s.toml:4: material.a.wetness: found 1.5, expected a number from 0 to 1",
        ),
        (
            &with("[material.a]\nshininess = [9, 8]\n"),
            "s.toml:4: material.a.shininess: found 9 and 8, expected a number from 0 to 65536, or",
        ),
        (
            &with("[material.a]\ncolor-map = 5\n"),
            "s.toml:4: material.a.color-map: found integer 5, expected the name of a file, or {",
        ),
        (
            &with("[material.a]\ncolor-map = { filter = \"nearest\" }\n"),
            "s.toml:4: material.a.color-map: found no file, expected one",
        ),
        (
            &with("[material.a]\ncolor-map = { file = \"a.png\", wrp = \"clamp\" }\n"),
            "s.toml:4: material.a.color-map.wrp: found the unknown key \"wrp\", expected one of file, filter, wrap; \
             did you mean wrap?",
        ),
        (
            &with("material = \"a\"\n[material.a]\n\nnormal-map = \"no.png\"\n"),
            "s.toml:6: material.a.normal-map: found no such file for the texture \"no.png\", expected",
        ),
        (
            &with("material = \"a\"\n[material.a]\nheight-map = \"b.obj\"\n"),
            "s.toml:5: material.a.height-map: found a file of another format for the texture \"b.obj\", expected",
        ),
        (
            &with("material = \"a\"\n[material.a]\nenvironment = \"a.png\"\nenvironment-kind = \"cube\"\n"),
            "s.toml:5: material.a.environment: found an image of 1x1 texels for a cube, expected six squares",
        ),
        (
            &with("[material.a]\nheight-map = { file = \"a.png\", filter = \"nearest\" }\n"),
            "s.toml:4: material.a.height-map.filter: found a key that has no use here, expected another map",
        ),
        (
            &with("[material.a]\nenvironment = { file = \"a.png\", filter = \"nearest\" }\n"),
            "s.toml:4: material.a.environment.filter: found a key that has no use here, expected another map",
        ),
        (
            &with("[material.a]\n\nenvironment = { file = \"a.png\", wrap = \"clamp\" }\n"),
            "s.toml:5: material.a.environment.wrap: found a key that has no use here, expected another map",
        ),
        (
            &with("[ambient]\nintensity = -1\n"),
            "s.toml:4: ambient.intensity: found -1, expected a number from 0 to 1000000",
        ),
        (
            &with("[[light]]\nintensity = 1\n"),
            "s.toml:3: light: found a light without kind, expected directional, point or spot",
        ),
        (&with("[[light]]\nkind = \"directional\"\n"), "s.toml:3: light: found a light that points nowhere"),
        (&with("[[light]]\nkind = \"point\"\n"), "s.toml:3: light: found a light without position"),
        (
            &with("[[light]]\nkind = \"point\"\nangle = 30\n"),
            "s.toml:5: light.angle: found a key that has no use here, expected a spot light",
        ),
        (
            &with("[[light]]\nkind = \"directional\"\ndirection = [0, 0, 0]\n"),
            "s.toml:5: light.direction: found no direction",
        ),
        (
            &with(
                "[[light]]\nkind = \"spot\"\nposition = [0, 0, 0]\ndirection = [0, 1, 0]\nangle = [30, 20]\n",
            ),
            "s.toml:7: light.angle: found 30 and 20 degrees",
        ),
        (
            &with("[[light]]\nkind = \"spot\"\nangle = 91\n"),
            "s.toml:5: light.angle: found 91, expected an angle above 0 and up to 90 degrees",
        ),
    ] {
        let message = refused(text);
        assert!(message.starts_with(wanted), "{text:?}\n   {message}\n   {wanted}");
        assert_eq!(message.lines().count(), 1);
        assert!(message.contains("found ") && message.contains(", expected "), "{message}");
    }
}

#[test]
fn unknown_keys_get_a_suggestion() {
    let message = refused("[[object]]\nsurfaec = \"plane\"\n");
    assert!(message.ends_with("; did you mean surface?"), "{message}");
    let message = refused(&format!("{MINIMAL}[camra]\n"));
    assert!(
        message.starts_with("s.toml:3: camra: ") && message.ends_with("; did you mean camera?"),
        "{message}"
    );
    let message = refused(&format!("{MINIMAL}[zebra]\n"));
    assert!(!message.contains("did you mean"), "{message}");
}

/// Slips of syntax are told in the words of all messages, with their remedies.
#[test]
fn slips_of_syntax_have_their_remedies() {
    let quotes = "expected a value; text has quotes around it, and values in brackets have commas between";
    let point =
        "expected the end of the line; decimals have a point, as in 1.5, and numbers that belong together";
    for (text, wanted) in [
        ("radius = 1,5", format!("found more after a value: \",5\", {point}")),
        ("position = 1,2,3", format!("found more after a value: \",2,3\", {point}")),
        (
            "rotation = [0, 05, 0]",
            "found a zero before a number, expected none; 5 is not written 05".to_owned(),
        ),
        ("material = ff0000", format!("found \"ff0000\", {quotes}")),
        ("model = tex/check.png", format!("found \"tex/check.png\", {quotes}")),
        ("model = check.png", format!("found \"check.png\", {quotes}")),
        ("model = \"C:\\models\\new.obj\"", "found a single \\ in text, expected two of them".to_owned()),
        ("segments = [3, 3", "found unclosed array, expected ]".to_owned()),
        (
            "size = 3, radius = 3",
            "found more after a value: \", radius = 3\", expected the end of the line; each key has"
                .to_owned(),
        ),
    ] {
        let message = refused(&format!("{MINIMAL}{text}\n"));
        let key = text.split(' ').next().unwrap();
        let line = MINIMAL.lines().count() + 1;
        let place = [format!("s.toml:{line}: object.{key}: "), format!("s.toml:{line}: {key}: ")];
        let rest = place.iter().find_map(|place| message.strip_prefix(place.as_str()));
        assert!(rest.is_some_and(|rest| rest.starts_with(&wanted)), "{text}: {message}");
    }
    let message = refused("[object]]\n");
    assert!(message.contains("a head has as many brackets at its end as at its start"), "{message}");
}

/// Keys about an alpha that no map has are told; a model may have one of its own.
#[test]
fn alpha_needs_a_map() {
    for line in ["blend = \"over\"", "alpha-test = 0.5"] {
        let text = format!("{MINIMAL}material = \"m\"\n[material.m]\ncolor = \"red\"\n{line}\n");
        let message = refused(&text);
        let key = line.split(' ').next().unwrap();
        let wanted =
            format!("s.toml:6: material.m.{key}: found it without color-map, expected color-map as well");
        assert!(message.starts_with(&wanted), "{message}");
        let triangle = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let text = text.replace("surface = \"plane\"", "model = \"b.obj\"");
        assert!(text.contains("b.obj"), "{text}");
        build(&[("s.toml", text.as_bytes()), ("b.obj", triangle)]).unwrap();
    }
}

/// A name to try is written as the wrong one is: from the folder of the file.
#[test]
fn suggested_files_start_where_the_scene_does() {
    let image = png(&[[1, 2, 3]]);
    let text = format!("{MINIMAL}material = \"m\"\n[material.m]\ncolor-map = \"./chek.png\"\n");
    let error = build(&[("s.toml", text.as_bytes()), ("check.png", &image)]).expect_err("a missing image");
    assert!(error.to_string().ends_with("; did you mean ./check.png?"), "{error}");
}

#[test]
fn animations_name_what_is_wrong_in_them() {
    let head = "[[object]]\nname = \"b\"\nsurface = \"sphere\"\n[[animation]]\n";
    for (text, wanted) in [
        ("", "s.toml:4: animation: found an animation without of, expected of = \"camera\""),
        (
            "of = \"c\"",
            "s.toml:5: animation.of: found the unknown name \"c\", expected one of camera, projector, ambient, b;",
        ),
        (
            "of = \"b\"",
            "s.toml:4: animation: found an animation without key, expected key, one of position, rot",
        ),
        (
            "of = \"b\"\nkey = \"radius\"",
            "s.toml:6: animation.key: found \"radius\", which does not move, expected one of",
        ),
        ("of = \"b\"\nkey = \"scale\"", "s.toml:4: animation: found an animation without times"),
        (
            "of = \"b\"\nkey = \"positon\"",
            "s.toml:6: animation.key: found \"positon\", which does not move, expected one of position, rotation, scale; \
             did you mean position?",
        ),
        ("of = \"b\"\nkey = \"scale\"\ntimes = []\nvalues = []", "s.toml:7: animation.times: found no times"),
        (
            "of = \"b\"\nkey = \"scale\"\ntimes = [0, 1]",
            "s.toml:4: animation: found an animation without values",
        ),
        (
            "of = \"b\"\nkey = \"scale\"\ntimes = [0, 1]\nvalues = [1]",
            "s.toml:8: animation.values: found 1 value for 2 times, expected one for each",
        ),
        (
            "of = \"b\"\nkey = \"scale\"\ntimes = [0,\n0]\nvalues = [1, 2]",
            "s.toml:8: animation.times: found 0 s, expected a time after",
        ),
        (
            "of = \"b\"\nkey = \"scale\"\ntimes = [-1]\nvalues = [1]",
            "s.toml:7: animation.times: found -1 s, expected 0 or later",
        ),
        (
            "of = \"b\"\nkey = \"scale\"\ntimes = [0, 1]\nvalues = [1,\n\"x\"]",
            "s.toml:9: animation.values: found \"x\", expected a number, numbers in brackets, or a colour",
        ),
        (
            "of = \"b\"\nkey = \"scale\"\ntimes = [0, 1]\nvalues = [1, [1, 2, 3]]",
            "s.toml:8: animation.values: found [1, 2, 3], expected a value like the first",
        ),
        (
            "of = \"b\"\nkey = \"position\"\ntimes = [0]\nvalues = [1]",
            "s.toml:8: animation.values: found 1, expected three numbers from -1e9 to 1e9",
        ),
        (
            "easing = \"fast\"",
            "s.toml:5: animation.easing: found \"fast\", expected one of linear, ease-in, ease-out,",
        ),
        (
            "of = \"b\"\nkey = \"scale\"\ntimes = [0]\nvalues = [1]\n[[animation]]\nof = \"b\"\nkey = \"scale\"\n\
             times = [0]\nvalues = [1]",
            "s.toml:11: animation.key: found a second animation of object[0].scale",
        ),
        (
            "of = \"camera\"\nkey = \"zoom\"\ntimes = [0, 1, 2, 3]\nvalues = [0.01, 100, 0.01, 0.01]\neasing = \"hold\"\n\
             [[object]]\nname = \"b\"\nsurface = \"plane\"",
            "s.toml:11: object.name: found the name \"b\" for the second time",
        ),
        (
            "of = \"camera\"\nkey = \"elevation\"\ntimes = [0, 1]\nvalues = [80, 95]",
            "s.toml:8: animation.values: found 95, expected an angle from -90 to 90 degrees",
        ),
        (
            "of = \"ambient\"\nkey = \"color\"\ntimes = [0, 1]\nvalues = [\"red\", \"blurple\"]",
            "s.toml:8: animation.values: found \"blurple\", expected a colour: rrggbb, rgb or a name",
        ),
    ] {
        let message = refused(&format!("{head}{text}\n"));
        assert!(message.starts_with(wanted), "{message}");
    }
}
