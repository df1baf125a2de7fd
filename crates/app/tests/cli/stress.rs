//! The app where there is too little: of the disk, of rights, of time, of readers. Where there is too much: `much`.

mod much;

use std::fs;
use std::io::Write as _;
use std::process::Command;

use crate::{Folder, Run, TRIANGLE};

/// Runs a script of a shell, in which `$A` is the command.
fn sh(folder: &Folder, script: &str) -> Run {
    let mut command = Command::new("sh");
    command.current_dir(folder.path(".")).args(["-c", script]).env("A", env!("CARGO_BIN_EXE_alberti"));
    let output = command.output().expect("a shell");
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Run { status: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// A failure as all are told: one line of a form, and status 2.
#[track_caller]
fn is_told(run: &Run, part: &str) {
    let lines: Vec<_> = run.stderr.lines().filter(|line| !line.starts_with("warning: ")).collect();
    assert_eq!((run.status, lines.len()), (Some(2), 1), "{run:?}");
    assert!(lines[0].starts_with("error: ") && lines[0].contains(part), "{part}: {run:?}");
    assert!(lines[0].contains("found ") && lines[0].contains(", expected "), "{run:?}");
}

/// A PNG file of one grey, whose data are right, or end before they have begun.
fn png(side: u32, is_whole: bool) -> Vec<u8> {
    let chunk = |kind: &[u8], data: &[u8]| {
        let mut sum = flate2::Crc::new();
        sum.update(kind);
        sum.update(data);
        let length = u32::try_from(data.len()).expect("a short chunk");
        [&length.to_be_bytes()[..], kind, data, &sum.sum().to_be_bytes()].concat()
    };
    let mut data = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
    let row = vec![0; side as usize + 1];
    (0..if is_whole { side } else { 0 }).for_each(|_| data.write_all(&row).expect("in memory"));
    let side = side.to_be_bytes();
    let head = [&side[..], &side, &[8, 0, 0, 0, 0]].concat();
    let data = data.finish().expect("in memory");
    [&b"\x89PNG\r\n\x1a\n"[..], &chunk(b"IHDR", &head), &chunk(b"IDAT", &data), &chunk(b"IEND", b"")].concat()
}

/// Runs lines of a shell with a file system of 64 KB in `d`, or says why that cannot be.
#[cfg(target_os = "linux")]
fn on_small_disk(folder: &Folder, options: &str, lines: &str) -> Option<Run> {
    fs::create_dir_all(folder.path("d")).expect("a folder");
    let mount = "mount -t tmpfs -o size=64k none d && cp old d/out.bmp && cp old d/out.exr || exit 77";
    let script =
        format!("{mount}\n{options}\n{lines}\nstatus=$?; cmp old d/out.bmp >&2; ls -A d; exit $status");
    fs::write(folder.path("script"), script).expect("a script");
    // A file system of this process alone, for which nobody has to be root where that is allowed.
    let run = sh(folder, "exec unshare --user --map-root-user --mount sh script");
    if run.status == Some(77) || run.stderr.contains("unshare") {
        eprintln!("NOT TESTED: no file system of 64 KB can be mounted here: {}", run.stderr);
        return None;
    }
    Some(run)
}

#[cfg(target_os = "linux")]
#[test]
fn full_disks_keep_what_they_have() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("old", b"old")]);
    for (arguments, named) in [
        ("m.obj -s 400x400 -o d/out.bmp", "error: d/out.bmp: "),
        ("m.obj -s 400x400 -o d/new.bmp", "error: d/new.bmp: "),
        // A picture that there is room for, with numbers that there is none for.
        ("m.obj -s 120x120 -o d/out.bmp --aov depth,normal,uv --aov-format exr", "error: d/out.exr: "),
        ("bake m.obj --texture t.png --out d", "error: d/m."),
    ] {
        fs::write(folder.path("t.png"), png(256, true)).expect("a file");
        let Some(run) = on_small_disk(&folder, "", &format!("\"$A\" {arguments}")) else { return };
        is_told(&run, "that writing fails (No space left on device");
        assert!(run.stderr.contains(named), "{run:?}");
        assert_eq!(run.stdout, "out.bmp\nout.exr\n", "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn folders_that_are_read_only_are_told_at_once() {
    // The model is broken, so that nothing is read before.
    let folder = Folder::with(&[("m.obj", b"broken"), ("old", b"old")]);
    for arguments in
        ["m.obj -o d/out.bmp", "m.obj -o d/new.png", "bake m.obj --out d", "bake m.obj --out d/new"]
    {
        let lines = format!("\"$A\" {arguments}");
        let Some(run) = on_small_disk(&folder, "mount -o remount,ro d", &lines) else { return };
        is_told(&run, "(Read-only file system");
        assert_eq!(run.stdout, "out.bmp\nout.exr\n", "{arguments}");
    }
}

/// A limit of a file's length is an error of writing, and no end by a signal.
#[cfg(unix)]
#[test]
fn files_may_be_limited() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("out.bmp", b"old")]);
    let run = sh(&folder, "ulimit -f 8 && exec \"$A\" m.obj -s 400x400 -o out.bmp");
    is_told(&run, "out.bmp: found that writing fails (");
    assert_eq!(folder.names(), ["m.obj", "out.bmp"]);
    assert_eq!(fs::read(folder.path("out.bmp")).expect("the picture"), b"old");
}

/// Allocators reserve addresses for each thread, and the end of them is no error of Rust's: an abort.
#[cfg(target_os = "linux")]
#[test]
fn addresses_may_be_limited() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for kib in [150_000, 200_000, 250_000, 300_000, 350_000, 600_000] {
        let run = sh(&folder, &format!("ulimit -v {kib} && exec \"$A\" m.obj -q -s 64x48"));
        assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""), "{kib}");
    }
}

/// While a model is read, whose end does not come; while much is drawn; and while files are written.
#[cfg(unix)]
#[test]
fn signals_leave_all_files_as_they_were() {
    use std::os::unix::process::ExitStatusExt as _;
    use std::process::Stdio;
    use std::time::{Duration, Instant};
    let both = [("-TERM", 15), ("-INT", 2)];
    let heeded = if crate::watch::ignores_sigint() { &both[..1] } else { &both };
    let olds = ["out.bmp", "out.exr"];
    for (arguments, is_begun) in [
        ("- -o out.bmp", None),
        ("- -o out.bmp --aov depth --aov-format exr", None),
        ("bake - --out new/deep", None),
        ("--scene hero -s 900x900 --samples 16 -j 1 -o out.bmp", None),
        (
            "--scene cube -s 700x700 --samples 1 -o out.bmp --aov depth,normal --aov-format exr",
            Some(".alberti-"),
        ),
    ] {
        for (signal, number) in heeded {
            let folder = Folder::with(&olds.map(|name| (name, &b"old"[..])));
            let mut child = Command::new(env!("CARGO_BIN_EXE_alberti"))
                .current_dir(folder.path("."))
                .args(arguments.split(' '))
                .stdin(Stdio::piped())
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .expect("the command");
            let mut input = child.stdin.take().expect("its input");
            // It has no input, or one that goes on.
            let _ = input.write_all(TRIANGLE.as_bytes());
            let start = Instant::now();
            // A temporary file is there for a moment before anything is read, without a byte.
            let begun = |name: &str| {
                let entries = fs::read_dir(folder.path(".")).expect("the folder").flatten();
                let mut files = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(name));
                folder.path(name).is_dir()
                    || files.any(|file| file.metadata().is_ok_and(|metadata| metadata.len() > 0))
            };
            match is_begun {
                Some(name) => {
                    while !begun(name) && child.try_wait().expect("a child").is_none() {
                        assert!(start.elapsed() < Duration::from_secs(300), "{name} does not begin");
                    }
                }
                None => std::thread::sleep(Duration::from_millis(150)),
            }
            let sent = Command::new("kill").args([signal, &child.id().to_string()[..]]).status();
            let status = child.wait().expect("the child");
            assert_eq!(folder.names(), olds, "{arguments} {signal}: {sent:?} {status:?}");
            let is_old = olds.map(|name| fs::read(folder.path(name)).expect("a file") == b"old");
            if status.success() {
                // It was faster than the signal, which the reading of a model is not.
                assert!(!is_old[0] && !arguments.contains("- "), "{arguments}");
            } else {
                assert_eq!(status.signal(), Some(*number), "{arguments}: {status:?}");
                assert!(is_old == [true; 2] || is_old == [false, !arguments.contains("exr")], "{arguments}");
            }
        }
    }
}

/// Standard output that nobody reads is no failure, unless the picture was to go there.
#[test]
fn nobody_has_to_read() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for (output, told) in [("p.png", ""), ("-", "error: standard output: found that writing fails (")] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut command = Command::new(env!("CARGO_BIN_EXE_alberti"));
        command.current_dir(folder.path(".")).args(["m.obj", "-s", "32x24", "--stats", "-o", output]);
        let made = command.stdout(writer).output().expect("the command");
        let errors = String::from_utf8(made.stderr).expect("text");
        assert_eq!(made.status.code(), Some(if told.is_empty() { 0 } else { 2 }), "{errors}");
        assert!(
            errors.starts_with(told) && errors.lines().count() == usize::from(!told.is_empty()),
            "{errors}"
        );
    }
    assert_eq!(folder.names(), ["m.obj", "p.png"]);
}
