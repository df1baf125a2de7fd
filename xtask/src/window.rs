//! A window in an X server without a screen: keys and the mouse change its picture, and what is kept is what was seen.

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::command::{Outcome, cargo, output, run};
use crate::workspace;

/// The scene in the window.
const SCENE: [&str; 6] = ["--scene", "mesh", "--size", "320x240", "-o", "kept.png"];

/// Keys after which the picture is another one.
const KEYS: [&str; 8] = ["Right", "plus", "s", "v", "V", "a", "0", "o"];

/// What the mouse does after these, each of which changes the picture as well.
const GESTURES: [(&str, &[&str]); 3] = [
    ("the wheel", &["mousemove", "--window", "%1", "90", "80", "click", "4"]),
    ("a drag", &["mousedown", "1", "mousemove_relative", "30", "15", "mouseup", "1"]),
    ("a drag of the right button", &["mousedown", "3", "mousemove_relative", "20", "-10", "mouseup", "3"]),
];

/// The longest wait for the window.
const PATIENCE: Duration = Duration::from_secs(30);

/// Pixels of a picture, with its width.
#[derive(Clone, PartialEq, Eq)]
struct Picture {
    width: usize,
    pixels: Vec<[u8; 3]>,
}

/// Processes that end with this.
struct Running(Vec<Child>);

impl Drop for Running {
    fn drop(&mut self) {
        for child in &mut self.0 {
            // One that has ended needs no end.
            _ = child.kill();
            _ = child.wait();
        }
    }
}

/// Opens a window, presses keys, and compares what is seen with what is drawn.
pub(crate) fn check() -> Outcome {
    for (program, package) in [("Xvfb", "xvfb"), ("xdotool", "xdotool"), ("xwd", "x11-apps")] {
        if Command::new("which")
            .arg(program)
            .stdout(Stdio::null())
            .status()
            .is_ok_and(|found| !found.success())
        {
            return Err(format!(
                "{program} is not here; install it, on Debian with `apt-get install {package}`"
            ));
        }
    }
    run(cargo().args(["build", "--release", "--package", "alberti-app"]))?;
    let program = workspace::target_directory().join("release/alberti");
    let folder = workspace::target_directory().join("window-check");
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(failed)?;
    without_display(&program, &folder)?;

    let mut running = Running(Vec::new());
    let mut server = Command::new("Xvfb");
    server.args(["-displayfd", "1", "-screen", "0", "2000x1400x24"]).stderr(Stdio::null());
    let mut server = server.stdout(Stdio::piped()).spawn().map_err(|error| format!("Xvfb: {error}"))?;
    let told = server.stdout.take().ok_or("Xvfb has no output")?;
    running.0.push(server);
    let mut number = String::new();
    BufReader::new(told).read_line(&mut number).map_err(failed)?;
    let display = format!(":{}", number.trim());

    // Text off: then all that is seen is the picture.
    let open = |words: &[&str], scale: &str, running: &mut Running| {
        let mut view = Command::new(&program);
        view.current_dir(&folder).env("DISPLAY", &display).env_remove("WAYLAND_DISPLAY");
        view.env("WINIT_X11_SCALE_FACTOR", scale);
        view.arg("view").args(words).stdout(fs::File::create(folder.join("told")).map_err(failed)?);
        running.0.push(view.spawn().map_err(|error| format!("{}: {error}", program.display()))?);
        let screen = Screen::new(display.clone())?;
        screen.press("Tab").map(|()| screen)
    };
    let screen = open(&SCENE, "1", &mut running)?;

    let drawn = |words: &[&str], name: &str| {
        let mut render = Command::new(&program);
        output(render.current_dir(&folder).arg("render").args(words).args(["-q", "-o", name]))?;
        png(&folder.join(name))
    };
    screen.wait_for("the picture of `render`", &drawn(&SCENE[..4], "first.png")?)?;
    let mut seen = screen.seen()?;
    for key in KEYS {
        screen.press(key)?;
        seen = screen.wait_for_another(&format!("the key `{key}`"), &seen)?;
    }
    for (gesture, words) in GESTURES {
        // `%1` is the window that a search has found.
        screen.tool(&[&["search", "--name", "alberti: "], words].concat())?;
        seen = screen.wait_for_another(gesture, &seen)?;
    }
    screen.press("p")?;
    let begin = Instant::now();
    let told = loop {
        let told = fs::read_to_string(folder.join("told")).map_err(failed)?;
        match told.lines().find_map(|line| line.strip_prefix("command: alberti render ")) {
            Some(command) => break command.to_owned(),
            None if begin.elapsed() > PATIENCE => return Err("`p` keeps no picture".into()),
            None => sleep(Duration::from_millis(50)),
        }
    };
    if png(&folder.join("kept.png"))? != seen {
        return Err("the picture that `p` keeps is not the one in the window".into());
    }
    let words: Vec<&str> = told.split_whitespace().collect();
    let again = drawn(&words, "again.png")?;
    if again != seen {
        return Err("the command that `p` prints does not make the picture again".into());
    }
    screen.press("q")?;
    let view = running.0.last_mut().ok_or("no window")?;
    let begin = Instant::now();
    loop {
        match view.try_wait().map_err(failed)? {
            Some(status) if status.success() => break,
            Some(status) => return Err(format!("the window ended with {status}")),
            None if begin.elapsed() > PATIENCE => return Err("`q` does not end it".into()),
            None => sleep(Duration::from_millis(20)),
        }
    }
    // A window without a size of its own is as large as others on a display with small pixels.
    let screen = open(&SCENE[..2], "2", &mut running)?;
    let large = [&SCENE[..2], &["--size", "1920x1280"]].concat();
    screen.wait_for("the picture of twice its size", &drawn(&large, "large.png")?)?;
    println!("a window, {} keys, the mouse, and its picture kept: all as `render` draws it", KEYS.len());
    Ok(())
}

/// Without a display there is one error.
fn without_display(program: &Path, folder: &Path) -> Outcome {
    let mut view = Command::new(program);
    view.current_dir(folder).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").arg("view").args(SCENE);
    let ended = view.output().map_err(|error| format!("{}: {error}", program.display()))?;
    let told = String::from_utf8_lossy(&ended.stderr).into_owned();
    let is_one = told.lines().count() == 1 && told.starts_with("error: alberti view: found no window");
    if ended.status.code() == Some(2) && is_one {
        return Ok(());
    }
    Err(format!("without a display: {}, {told}", ended.status))
}

/// The window on a display.
struct Screen {
    display: String,
    window: String,
}

impl Screen {
    /// Waits for the window.
    fn new(display: String) -> Result<Self, String> {
        let begin = Instant::now();
        loop {
            let mut search = Command::new("xdotool");
            search.env("DISPLAY", &display).args(["search", "--onlyvisible", "--name", "alberti: "]);
            if let Some(window) =
                output(&mut search).ok().and_then(|found| Some(found.lines().next()?.to_owned()))
            {
                let screen = Self { display, window };
                screen.tool(&["windowfocus", "--sync", &screen.window])?;
                return Ok(screen);
            }
            if begin.elapsed() > PATIENCE {
                return Err("no window opens".into());
            }
            sleep(Duration::from_millis(100));
        }
    }

    fn tool(&self, words: &[&str]) -> Outcome {
        output(Command::new("xdotool").env("DISPLAY", &self.display).args(words)).map(|_| ())
    }

    fn press(&self, key: &str) -> Outcome {
        self.tool(&["key", key])
    }

    fn seen(&self) -> Result<Picture, String> {
        let mut dump = Command::new("xwd");
        dump.env("DISPLAY", &self.display).args(["-silent", "-id", &self.window]);
        let dump = dump.output().map_err(|error| format!("xwd: {error}"))?;
        xwd(&dump.stdout).ok_or_else(|| "xwd wrote a picture of another form".to_owned())
    }

    fn wait_for(&self, what: &str, picture: &Picture) -> Outcome {
        let begin = Instant::now();
        while self.seen()? != *picture {
            if begin.elapsed() > PATIENCE {
                return Err(format!("the window does not show {what}"));
            }
            sleep(Duration::from_millis(50));
        }
        Ok(())
    }

    /// A picture that is not this one, and stays for a while: it is no draft.
    fn wait_for_another(&self, what: &str, picture: &Picture) -> Result<Picture, String> {
        let begin = Instant::now();
        let mut last = picture.clone();
        while begin.elapsed() < PATIENCE {
            sleep(Duration::from_millis(400));
            let next = self.seen()?;
            if next != *picture && next == last {
                return Ok(next);
            }
            last = next;
        }
        Err(format!("{what} does not change the picture"))
    }
}

/// A picture of xwd: numbers of 32 bits from the most significant byte on, a table of colours, and rows.
fn xwd(bytes: &[u8]) -> Option<Picture> {
    let number = |k: usize| {
        let word = bytes.get(4 * k..4 * k + 4)?;
        usize::try_from(u32::from_be_bytes(word.try_into().ok()?)).ok()
    };
    let [header, width, height] = [number(0)?, number(4)?, number(5)?];
    let [order, bits, row, colors] = [number(7)?, number(11)?, number(12)?, number(19)?];
    if order != 0 || bits != 32 || row == 0 {
        return None;
    }
    let data = bytes.get(header + 12 * colors..)?;
    let rows = data.chunks(row).take(height);
    let pixels = rows.flat_map(|row| row.chunks_exact(4).take(width).map(|p| [p[2], p[1], p[0]])).collect();
    Some(Picture { width, pixels })
}

fn png(path: &Path) -> Result<Picture, String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let file = fs::File::open(path).map_err(|error| failed(&error))?;
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(|error| failed(&error))?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("a picture that is too large")?];
    let info = reader.next_frame(&mut bytes).map_err(|error| failed(&error))?;
    let channels = info.color_type.samples();
    let pixels = bytes[..info.buffer_size()].chunks_exact(channels).map(|p| [p[0], p[1], p[2]]).collect();
    Ok(Picture { width: info.width as usize, pixels })
}
