//! The pictures in docs/pictures are what the examples draw now, byte by byte. After a change that is meant, run the
//! example by the command at its top, with the picture's path there.
//!
//! The examples are those that `cargo test` has built, so that their kernels are compiled once.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

/// The program of an example.
fn program(name: &str) -> PathBuf {
    let test = env::current_exe().expect("the path of this test");
    let built = test.ancestors().nth(2).expect("the folder above that of tests").join("examples").join(name);
    let built = built.with_extension(env::consts::EXE_EXTENSION);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name).with_extension("rs");
    let time = |path: &Path| fs::metadata(path).and_then(|metadata| metadata.modified());
    let is_new = time(&built).is_ok_and(|time_built| time(&source).is_ok_and(|time| time <= time_built));
    assert!(
        is_new,
        "{} is not that of {}: `cargo test --workspace` builds it",
        built.display(),
        source.display()
    );
    built
}

/// Draws what the picture of this name shows, and compares the two.
fn compare(name: &str) -> io::Result<()> {
    let (example, _) = name.split_once('.').expect("a kind of files");
    let drawn = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let told = Command::new(program(example)).arg(&drawn).output()?;
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    let committed = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/pictures").join(name))?;
    let drawn = fs::read(drawn)?;
    assert!(drawn == committed, "docs/pictures/{name} is not what its example draws");
    assert!(drawn.len() < 90_000, "{name} has {} bytes", drawn.len());
    Ok(())
}

macro_rules! pictures {
    ($($test:ident: $name:literal),* $(,)?) => {
        $(
            #[test]
            fn $test() -> io::Result<()> {
                compare($name)
            }
        )*
    };
}

pictures! {
    affine_and_hyperbolic: "affine_and_hyperbolic.png",
    after_the_fragment: "after_the_fragment.png",
    color_triangle: "color_triangle.png",
    depth_precision: "depth_precision.png",
    embedded_graphics: "embedded_graphics.png",
    firmware_frame: "firmware_frame.png",
    materials: "materials.png",
    perspective_cube: "perspective_cube.gif",
    slide_projector: "slide_projector.png",
    smooth_edges: "smooth_edges.png",
}
