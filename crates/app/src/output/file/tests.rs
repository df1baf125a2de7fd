//! Files that are whole or not there, in a folder of their own.

use super::*;

fn picture() -> Image {
    Image { width: 2, height: 1, texels: vec![[255, 0, 0, 255], [0, 0, 255, 255]] }
}

#[test]
fn every_format_reads_back() {
    let folder = tempfile::tempdir().unwrap();
    for (extension, format) in FORMATS {
        let path = folder.path().join(format!("a.{}", extension.to_uppercase()));
        Output::new(&path, None).unwrap().write(&picture()).unwrap();
        let bytes = fs::read(&path).unwrap();
        // Colours without runs, which would go on from row to row: not all programs read those.
        assert!(format != ImageFormat::Tga || bytes[2] == 2);
        let back = image::load_from_memory_with_format(&bytes, format).unwrap();
        assert_eq!((back.width(), back.height()), (2, 1));
        if format != ImageFormat::Jpeg {
            assert_eq!(back.to_rgba8().as_raw(), &[255, 0, 0, 255, 0, 0, 255, 255]);
        }
        let clear = Image { width: 1, height: 2, texels: vec![[9, 8, 7, 6], [255, 0, 0, 255]] };
        let output = Output::new(&path, None).unwrap();
        assert_eq!(output.write_with_alpha(&clear).is_ok(), WITH_ALPHA.contains(&format));
        if WITH_ALPHA.contains(&format) {
            let back = image::load_from_memory_with_format(&fs::read(&path).unwrap(), format).unwrap();
            assert_eq!(back.to_rgba8().as_raw(), clear.texels.as_flattened());
        }
        fs::remove_file(path).unwrap();
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn what_cannot_be_written_is_known_early() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("d.png")).unwrap();
    fs::write(at("file"), "").unwrap();
    fs::write(at("r.png"), "").unwrap();
    let mut permissions = fs::metadata(at("r.png")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(at("r.png"), permissions).unwrap();
    for (name, found) in [
        ("a", "found no extension, expected one of .png"),
        ("a.gif", "found the extension \".gif\", expected one of .png"),
        ("a.exr", "numbers: --aov depth --aov-format exr"),
        ("a.mp4", "films are made by alberti turntable"),
        ("d.png", "found a directory"),
        ("file/a.png", "found a file in the place of its folder"),
        ("r.png", "found a file that is read-only"),
        ("x.png/", "found the name of a folder"),
        (&format!("{}.png", "x".repeat(300)), "found a name that no file can have"),
    ] {
        let message = Output::new(&at(name), None).unwrap_err().to_string();
        assert!(message.contains(found), "{message}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}

#[test]
fn folders_are_made_when_there_is_something_to_write() {
    let folder = tempfile::tempdir().unwrap();
    let output = Output::new(&folder.path().join("new/deep/a.png"), None).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    output.write(&picture()).unwrap();
    let made = |name: &str| fs::read_dir(folder.path().join(name)).unwrap().count();
    assert_eq!(["", "new", "new/deep"].map(made), [1; 3]);
    let within = Output::new(&folder.path().join("new/deep/a.png/b.png"), None).unwrap_err().to_string();
    assert!(within.contains("found a file in the place of its folder"), "{within}");
}

#[test]
fn files_that_belong_together_are_written_together() {
    let folder = tempfile::tempdir().unwrap();
    let (first, gone) = (folder.path().join("a"), folder.path().join("gone"));
    fs::write(&first, "old").unwrap();
    let files = [&first, &gone.join("b")].map(|path| Whole::new(path, "--out").unwrap());
    let write = || Whole::write_all(&[(&files[0], b"new"), (&files[1], b"new")]);
    fs::write(&gone, "").unwrap();
    let message = write().unwrap_err().to_string();
    assert!(message.contains("found a file in the place of its folder"), "{message}");
    assert_eq!(fs::read(&first).unwrap(), b"old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    fs::remove_file(&gone).unwrap();
    write().unwrap();
    assert_eq!([fs::read(&first).unwrap(), fs::read(gone.join("b")).unwrap()], [b"new", b"new"]);
}

/// A folder that exists is never said to be missing.
#[cfg(target_os = "linux")]
#[test]
fn folders_of_the_system_take_no_new_files() {
    let message = Output::new(Path::new("/proc/x.png"), None).unwrap_err().to_string();
    let expected = "/proc/x.png: found a folder that takes no new files, expected a file that can be written";
    assert!(message.starts_with(expected), "{message}");
}

#[cfg(unix)]
#[test]
fn links_are_written_through() {
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("a.png"), folder.path().join("l.png"));
    fs::write(&file, "old").unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    let output = Output::new(&link, None).unwrap();
    assert_eq!(fs::read(&file).unwrap(), b"old");
    output.write(&picture()).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(fs::read(&file).unwrap().starts_with(b"\x89PNG"));
    assert!(output.is(&file));
    // Permissions stay, and a link to nothing yet is followed as well.
    use std::os::unix::fs::PermissionsExt as _;
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    output.write(&picture()).unwrap();
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
    fs::remove_file(&file).unwrap();
    Output::new(&link, None).unwrap().write(&picture()).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink() && file.is_file());
}
