//! Tests of the OBJ check: what it repairs, what it refuses, and where it says that is.

use std::path::Path;

use super::*;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn run(text: &[u8]) -> Result<CheckedObj, Error> {
    check(text, Path::new("m.obj"), &mut |_| {})
}

fn message(text: &str) -> String {
    match run(text.as_bytes()) {
        Ok(checked) => panic!("accepted: {}{}", checked.head, checked.body),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_plain_file_gets_three_indices_and_a_colour() {
    let checked = run(format!("{TRIANGLE}f 1 2 3\n").as_bytes()).unwrap();
    assert_eq!(checked.head, "vt 0 0\nvn 0 0 0\nv 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\n");
    assert_eq!(checked.body, "f 1/1/1 2/1/1 3/1/1\n");
}

#[test]
fn indices_are_shifted_and_negative_ones_resolved() {
    let text = format!("{TRIANGLE}vt 0.5 0.25\nvn 0 0 1\nf -3/-1/-1 -2//1 3/1\n");
    assert_eq!(run(text.as_bytes()).unwrap().body, "f 1/2/2 2/1/2 3/2/1\n");
}

#[test]
fn an_index_may_point_forward() {
    let checked = run(format!("f 1 2 3\n{TRIANGLE}").as_bytes()).unwrap();
    assert_eq!(checked.body, "f 1/1/1 2/1/1 3/1/1\n");
}

#[test]
fn homogeneous_vertices_are_divided() {
    let checked = run(b"v 2 4 6 2\nv 0 0 0\nv 1 1 1\nf 1 2 3").unwrap();
    assert!(checked.head.contains("v 1 2 3 1 1 1\n"));
}

#[test]
fn what_is_not_drawn_is_ignored() {
    let text = format!("{TRIANGLE}vp 1 2\ns off\nl 1 99\np 7\ncurv2 x\nf 1 2 3 # last\n#f 9 9 9\n");
    assert_eq!(run(text.as_bytes()).unwrap().body, "f 1/1/1 2/1/1 3/1/1\n");
}

#[test]
fn other_line_forms_are_read() {
    let text = b"\xef\xbb\xbf# \xff\xfe\r\n\tv 0 0 0\r\n  v\t1 0 0\r\nv 0 1 0\r\nusemtl\tred \xff #1\r\nf 1 \\\r\n 2 3";
    let checked = run(text).unwrap();
    assert_eq!(checked.body, "usemtl red \u{fffd} #1\nf 1/1/1 2/1/1 3/1/1\n");
    assert_eq!(checked.materials, [Named { name: "red \u{fffd} #1".to_owned(), line: 5 }]);
}

#[test]
fn files_that_are_not_models_are_refused() {
    assert!(message("").starts_with("m.obj: found an empty file, expected a Wavefront OBJ model"));
    assert!(message("a\0b").starts_with("m.obj: found a binary file (a zero byte at offset 1)"));
    assert!(message("Dear reader,\n\nhello\n").starts_with("m.obj: found no faces in 3 lines, expected"));
    assert!(message(TRIANGLE).contains("no faces"));
    assert!(run(b"\xff\xfev\0").unwrap_err().to_string().contains("UTF-16"));
}

#[test]
fn coordinates_are_finite_numbers() {
    for bad in ["nan", "inf", "-inf", "1e400", "abc", "1,5", "0x1"] {
        for line in [format!("v 0 {bad} 0"), format!("vt {bad} 0"), format!("vn 0 0 {bad}")] {
            let message = message(&format!("# one\n{line}\nf 1 1 1\n"));
            assert!(
                message.starts_with(&format!("m.obj:2: found \"{bad}\", expected a finite")),
                "{message}"
            );
        }
    }
    assert!(message("v 1e20 0 0").starts_with("m.obj:1: found a coordinate of 1e20, expected"));
    assert!(message("v 0 0 0 0").starts_with("m.obj:1: found a coordinate of NaN, expected"));
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
        ("f 1 2", "a face with 2 corners"),
        ("f 1", "a face with 1 corner,"),
        ("f", "a face with 0 corners"),
    ] {
        let message = message(&format!("{TRIANGLE}{line}\n"));
        assert!(message.starts_with(&format!("m.obj:4: found {found}")), "{message}");
    }
}

#[test]
fn indices_exist() {
    for (face, found) in [
        ("f 1 2 4", "vertex index 4, expected 1 to 3"),
        ("f 0 1 2", "vertex index 0, expected 1 to 3"),
        ("f -4 1 2", "vertex index -4, expected -1 to -3"),
        ("f 1/-5 2/1 3/1", "texture coordinate index -5, expected -1 to -1"),
        ("f 1/1 2/2 3/1", "texture coordinate index 2, expected 1 to 1"),
        ("f 1//1 2//1 3//1", "normal index 1, expected none"),
        ("f 1//9223372036854775807 2 3", "normal index 9223372036854775807, expected none"),
        ("f 1//-9223372036854775808 2 3", "normal index -9223372036854775808, expected none"),
        ("f 1 2 99999999999999999999", "vertex index 9223372036854775807, expected"),
        ("f 1 2 -99999999999999999999", "vertex index -99999999999999999999, expected"),
        ("f 1 2 x", "\"x\" in a face, expected whole numbers"),
        ("f 1 2 1.5", "\"1.5\" in a face, expected whole numbers"),
        ("f 1 2 /1", "\"/1\" in a face, expected whole numbers"),
        ("f 1/1//1 2 3", "\"1/1//1\" in a face"),
    ] {
        let message = message(&format!("{TRIANGLE}vt 0 0\n{face}\n"));
        assert!(message.starts_with(&format!("m.obj:5: found {found}")), "{message}");
    }
}
