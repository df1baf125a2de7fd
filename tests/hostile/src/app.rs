//! The application on hostile files: one error or a picture, nothing left behind, and no more memory than it says.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use alberti_app::cli::run as command;

/// A folder of this process, in memory where there is one.
static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
    let memory = Path::new("/dev/shm");
    let made = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() };
    made.expect("a folder for files")
});

/// A row of three files in one: each ends before a line of two percent signs.
fn parts<const N: usize>(bytes: &[u8]) -> [&[u8]; N] {
    const END: &[u8] = b"\n%%\n";
    let mut rest = bytes;
    let mut parts = [&[][..]; N];
    for part in &mut parts {
        let end = rest.windows(END.len()).position(|window| window == END);
        let at = end.unwrap_or(rest.len());
        *part = &rest[..at];
        rest = rest.get(at + END.len()..).unwrap_or_default();
    }
    parts
}

fn path(name: &str) -> PathBuf {
    FOLDER.path().join(name)
}

/// All files in the folder.
fn there() -> impl Iterator<Item = PathBuf> {
    let entries = fs::read_dir(FOLDER.path()).expect("the folder");
    entries.map(|entry| entry.expect("a file").path())
}

/// Runs the command with these words, the files beside it, and looks at what it leaves.
fn run(files: &[(&str, &[u8])], words: &[&str]) {
    there().for_each(|file| fs::remove_file(file).expect("a file of another case"));
    for (name, bytes) in files {
        fs::write(path(name), bytes).expect("a file in the folder");
    }
    let output = path("out.png");
    let place = |word: &&str| match word.strip_prefix('@') {
        Some(name) => path(name).into_os_string(),
        None => OsString::from(word),
    };
    let words = ["alberti"].iter().chain(words).map(place).collect::<Vec<_>>();
    let made = match command::attempt(words) {
        Ok(status) => status == 0,
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("found ") && message.contains(", expected "), "{message}");
            assert!(!message.contains(char::is_control), "{message:?}");
            false
        }
    };
    // A picture is there if it was a success, and nothing else ever is.
    assert_eq!(output.exists(), made, "a picture or none");
    assert_eq!(there().count(), files.len() + usize::from(made), "files are left");
    for (name, bytes) in files {
        assert!(fs::read(path(name)).is_ok_and(|now| now == *bytes), "{name} was changed");
    }
}

/// A small picture by one thread, without a word.
const SMALL: [&str; 8] = ["-o", "@out.png", "-s", "17x13", "--samples", "1", "-j", "1"];

fn drawn(files: &[(&str, &[u8])], model: &str, more: &[&str]) {
    run(files, &[&["render", model][..], &SMALL, &["-q"], more].concat());
}

/// OBJ files, with a library behind them.
pub(crate) fn obj(bytes: &[u8]) {
    let [obj, mtl] = parts(bytes);
    drawn(&[("m.obj", obj), ("m.mtl", mtl)], "@m.obj", &[]);
}

/// Libraries of materials, for a square with coordinates, and a texture behind them.
pub(crate) fn mtl(bytes: &[u8]) {
    const OBJ: &[u8] = b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
        usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n";
    let [mtl, png] = parts(bytes);
    drawn(&[("m.obj", OBJ), ("m.mtl", mtl), ("t.png", png)], "@m.obj", &[]);
}

/// Scene files.
pub(crate) fn scene(bytes: &[u8]) {
    const OBJ: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    let [toml, png] = parts(bytes);
    drawn(&[("s.toml", toml), ("m.obj", OBJ), ("t.png", png)], "@s.toml", &[]);
}

/// Images, as a texture and as heights.
pub(crate) fn image(bytes: &[u8]) {
    const OBJ: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    let (kind, image) = bytes.split_first().unwrap_or((&0, &[]));
    let more = match kind % 3 {
        0 => ["--texture", "@t.tga"],
        1 => ["--height-map", "@t.tga"],
        _ => ["--background", "@t.tga"],
    };
    drawn(&[("m.obj", OBJ), ("t.tga", image)], "@m.obj", &more);
}

/// Options: words of a line, of which files are those of the folder alone.
pub(crate) fn options(bytes: &[u8]) {
    const OBJ: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(400)]);
    let words: Vec<&str> = text.split_ascii_whitespace().collect();
    // No other command, file or size of pictures: those have targets of their own.
    let long = [
        "-o",
        "--output",
        "-s",
        "--size",
        "--samples",
        "-j",
        "--threads",
        "--stats",
        "--aov",
        "--list-scenes",
    ];
    let refused = |word: &&str| {
        let name = word.split('=').next().unwrap_or(word);
        word.contains('/')
            || *word == "-"
            || *word == "--"
            || word.starts_with('@')
            || long.contains(&name)
            || ["-h", "--help", "-V", "--version"].contains(&name)
            || (name.starts_with('-') && !name.starts_with("--"))
            || long.iter().any(|option| name.len() > 2 && option.starts_with(name))
    };
    if words.iter().any(refused) {
        return;
    }
    drawn(&[("m.obj", OBJ)], "@m.obj", &words);
}
