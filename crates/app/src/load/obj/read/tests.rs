//! Tests of the reading: what is understood, what is refused, and where it says that is.

use std::fs;

use super::super::block::MAX_COORDINATE;
use super::*;
use crate::load::input;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn run(text: &[u8]) -> Result<ObjText, Error> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("m.obj");
    fs::write(&file, text).unwrap();
    let mut stream = Stream::open(&file, KIND, input::MAX_TEXT_BYTES)?;
    ObjText::read(&mut stream, Path::new("m.obj"), &mut |_, _| {})
}

fn message(text: &str) -> String {
    match run(text.as_bytes()) {
        Ok(read) => panic!("accepted: {read:?}"),
        Err(error) => error.to_string(),
    }
}

/// All corners.
fn corners(text: &[u8]) -> Vec<[u32; 3]> {
    run(text).unwrap().faces.into_iter().flat_map(|faces| faces.corners).collect()
}

#[test]
fn indices_of_all_forms_are_read() {
    let text = format!("{TRIANGLE}vt 0.5 0.25\nvn 0 0 1\nf -3/-1/-1 -2//1 3/1\nf 1/ 2// 3/1/1\n");
    let wanted = [[1, 1, 1], [2, 0, 1], [3, 1, 0], [1, 0, 0], [2, 0, 0], [3, 1, 1]];
    assert_eq!(corners(text.as_bytes()), wanted);
    assert_eq!(
        corners(format!("{TRIANGLE}f +1 02 0000000000003\n").as_bytes()),
        [[1, 0, 0], [2, 0, 0], [3, 0, 0]]
    );
}

#[test]
fn an_index_may_point_forward() {
    assert_eq!(corners(format!("f 1 2 3\n{TRIANGLE}").as_bytes()), [[1, 0, 0], [2, 0, 0], [3, 0, 0]]);
}

#[test]
fn homogeneous_vertices_are_divided() {
    let read = run(b"v 2 4 6 2\nv 0 0 0\nv 1 1 1\nf 1 2 3").unwrap();
    assert_eq!(read.positions[0], [1.0, 2.0, 3.0]);
}

#[test]
fn positions_have_64_bits() {
    let read = run(b"v 500000.123456 120.000001 -4000000.654321\nf 1 1 1").unwrap();
    assert_eq!(read.positions[0], [500_000.123_456, 120.000_001, -4_000_000.654_321]);
}

#[test]
fn what_is_not_drawn_is_ignored() {
    let text = format!("{TRIANGLE}vp 1 2\nl 1 99\np 7\ncurv2 x\nf 1 2 3 # last\n#f 9 9 9\n");
    assert_eq!(corners(text.as_bytes()), [[1, 0, 0], [2, 0, 0], [3, 0, 0]]);
}

#[test]
fn statements_stand_between_faces() {
    let text = format!("{TRIANGLE}s 4\no a\nf 1 2 3\ns off\ns\ns none\nusemtl m\nf 1 2 3\ng b\n");
    let faces = run(text.as_bytes()).unwrap().faces.remove(0);
    let (object, smoothing) = (|name: &str| Event::Object(name.to_owned()), Event::Smoothing);
    let wanted = [
        (0, smoothing(4)),
        (0, object("a")),
        (1, smoothing(0)),
        (1, smoothing(0)),
        (1, smoothing(1)),
        (1, Event::Material("m".to_owned(), 10)),
        (2, object("b")),
    ];
    assert_eq!(faces.events, wanted);
    assert_eq!(faces.faces.iter().map(|face| face.line).collect::<Vec<_>>(), [6, 11]);
}

#[test]
fn other_line_forms_are_read() {
    let text = b"\xef\xbb\xbf# \xff\xfe\r\n\tv 0 0 0\r\n  v\t1 0 0\r\nv 0 1 0\r\nusemtl\tred \xff #1\r\nf 1 \\\r\n 2 3";
    let read = run(text).unwrap();
    assert_eq!(read.materials, [Named { name: "red \u{fffd} #1".to_owned(), line: 5 }]);
    assert_eq!(read.faces[0].corners, [[1, 0, 0], [2, 0, 0], [3, 0, 0]]);
}

#[test]
fn files_that_are_not_models_are_refused() {
    assert!(message("").starts_with("m.obj: found an empty file, expected a Wavefront OBJ model"));
    assert!(message("a\0b").starts_with("m.obj: found a binary file (a zero byte at offset 1)"));
    assert!(message("Dear reader,\n\nhello\n").starts_with("m.obj: found no faces in 3 lines, expected"));
    assert!(message(TRIANGLE).contains("no faces"));
    assert!(
        message("size = [9, 9]\n[camera]\neye = [0, 0, 9]\n")
            .ends_with("told by its name, which ends in .toml")
    );
    assert!(run(b"\xff\xfev\0").unwrap_err().to_string().contains("UTF-16"));
}

#[test]
fn coordinates_are_finite_numbers() {
    for bad in ["nan", "inf", "-inf", "1e400", "abc", "1,5", "0x1"] {
        let others = [format!("vt {bad} 0"), format!("vn 0 0 {bad}")];
        // Of these, such words are taken for none.
        let others = others.into_iter().filter(|_| !["nan", "inf", "-inf"].contains(&bad));
        for line in others.chain([format!("v 0 {bad} 0")]) {
            let message = message(&format!("# one\n{line}\nf 1 1 1\n"));
            assert!(
                message.starts_with(&format!("m.obj:2: found \"{bad}\", expected a finite")),
                "{message}"
            );
        }
    }
    assert!(message("v 0 1e39 0").starts_with("m.obj:1: found \"1e39\", expected a smaller number"));
    assert!(message("v 1e20 0 0").starts_with("m.obj:1: found a coordinate of 1e20, expected"));
    assert!(message("v 0 0 0 0").starts_with("m.obj:1: found a coordinate of NaN, expected"));
    assert!(run(format!("v {MAX_COORDINATE} 0 0\nf 1 1 1").as_bytes()).is_ok());
}

#[test]
fn numbers_are_counted() {
    for (line, found) in [
        ("v 1 2", "`v` with 2 numbers"),
        ("v", "`v` with 0 numbers"),
        ("v 1 2 3 4 5", "`v` with 5 numbers"),
        ("v 1 2 3 4 5 6 7", "`v` with 7 numbers"),
        ("vt", "`vt` with 0 numbers"),
        ("vn 0 1", "`vn` with 2 numbers"),
    ] {
        let message = message(&format!("{TRIANGLE}{line}\n"));
        assert!(message.starts_with(&format!("m.obj:4: found {found}")), "{message}");
    }
}

/// Faces of one or two corners are counted, and nothing of them is kept.
#[test]
fn faces_of_fewer_corners_are_left_out() {
    let text = format!("{TRIANGLE}vt 0 0\nf 1/1 2/1 3/1\nf 1/1 -1/-1\nf -2\nf\nf -1 -2 -3\n");
    let read = run(text.as_bytes()).unwrap();
    assert_eq!(read.undrawn().as_deref(), Some("3 faces with fewer than 3 corners"));
    assert_eq!(read.corners_with_uv, 3);
    let corners: Vec<_> =
        read.faces.iter().flat_map(|faces| &faces.corners).map(|corner| corner[0]).collect();
    assert!(corners.ends_with(&[1, 2, 3, 3, 2, 1]), "{corners:?}");
    let faces = read.faces.iter().flat_map(|faces| &faces.faces);
    assert!(faces.map(|face| face.corners).eq([3; 2]));
}

#[test]
fn indices_exist() {
    for (face, found) in [
        ("f 1 2 4", "vertex index 4, expected 1 to 3"),
        ("f 0 1 2", "vertex index 0, expected 1 to 3"),
        ("f -4 1 2", "vertex index -4, expected -1 to -3"),
        ("f 1/-5 2/1 3/1", "texture coordinate index -5, expected -1 to -1"),
        ("f 1/1 2/2 3/1", "texture coordinate index 2, expected 1 to 1"),
        ("f 1//9223372036854775807 2 3", "normal index 9223372036854775807, expected 1 to 1"),
        ("f 1//-9223372036854775808 2 3", "normal index -9223372036854775808, expected -1 to -1"),
        ("f 1 2 99999999999999999999", "vertex index 99999999999999999999, expected"),
        ("f 1 2 -99999999999999999999", "vertex index -99999999999999999999, expected"),
        ("f 1 2 x", "\"x\" in a face, expected whole numbers"),
        ("f 1 2 1.5", "\"1.5\" in a face, expected whole numbers"),
        ("f 1 2 /1", "\"/1\" in a face, expected whole numbers"),
        ("f 1/1//1 2 3", "\"1/1//1\" in a face"),
        ("f 1 2 -1/x", "\"-1/x\" in a face"),
        ("f 1 2 -9/x", "vertex index -9, expected -1 to -3"),
        ("f -9 2 x", "vertex index -9, expected -1 to -3"),
    ] {
        let message = message(&format!("{TRIANGLE}vt 0 0\nvn 0 0 1\n{face}\n"));
        assert!(message.starts_with(&format!("m.obj:6: found {found}")), "{message}");
    }
}

/// A text of several blocks: `n` triples of a line of each kind, and a face each.
fn long(n: usize, end: &str) -> String {
    use std::fmt::Write as _;
    let mut text = String::new();
    for i in 1..=n {
        write!(text, "v {i} 0.5 -1{end}vt 0.{i} 1{end}vn 0 1 0{end}f -1/-1/-1 {i}/{i}/{i} {i}//{i}{end}")
            .unwrap();
    }
    text
}

#[test]
fn blocks_are_one_text() {
    let n = 300_000;
    for end in ["\n", "\r\n", "\r", " \\\n\n"] {
        let text = long(n, end);
        assert!(text.len() > 4 * BLOCK, "{}", text.len());
        let read = run(text.as_bytes()).unwrap();
        assert!(read.faces.len() > 2);
        assert_eq!((read.positions.len(), read.uvs.len(), read.normals.len()), (n, n, n));
        assert!(
            read.positions.iter().zip(1_u32..).all(|(position, i)| *position == [f64::from(i), 0.5, -1.0])
        );
        let lines_each = if end.ends_with("\n\n") { 8 } else { 4 };
        let mut i = 0;
        for faces in &read.faces {
            for (face, corners) in faces.faces.iter().zip(faces.corners.chunks(3)) {
                i += 1;
                assert_eq!(corners, [[i, i, i], [i, i, i], [i, 0, i]]);
                assert_eq!(
                    face.line,
                    lines_each * (i - 1) + lines_each - if lines_each == 8 { 1 } else { 0 }
                );
            }
        }
        // Errors far behind are where they are.
        let message = message(&format!("{text}v 1 2{end}"));
        assert!(
            message.starts_with(&format!("m.obj:{}: found `v` with 2", n * lines_each as usize + 1)),
            "{message}"
        );
        let bad = format!("{text}f 1 1 -{}{end}", n + 1);
        let found = format!(
            "m.obj:{}: found vertex index -{}, expected -1 to -{n}",
            n * lines_each as usize + 1,
            n + 1
        );
        assert!(self::message(&bad).starts_with(&found), "{}", self::message(&bad));
        let bad = format!("{text}f 1 1 {}{end}", n + 1);
        let found =
            format!("m.obj:{}: found vertex index {}, expected 1 to {n}", n * lines_each as usize + 1, n + 1);
        assert!(self::message(&bad).starts_with(&found), "{}", self::message(&bad));
    }
}

#[test]
fn texts_are_cut_between_lines() {
    assert_eq!(cut(b"v 1\nv 2"), 4);
    assert_eq!(cut(b"v 1\nv 2\r"), 4);
    assert_eq!(cut(b"v 1\rv 2"), 4);
    assert_eq!(cut(b"v 1\r\nv 2"), 5);
    assert_eq!(cut(b"v 1\nf 2\\ \r\n3"), 4);
    assert_eq!((cut(b"v 1 2"), cut(b""), cut(b"f 1\\\n2")), (0, 0, 0));
}
