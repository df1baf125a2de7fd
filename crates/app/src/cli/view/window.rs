//! The window: events in, pixels out.

use std::num::NonZero;
use std::rc::Rc;
use std::time::{Duration, Instant};

use softbuffer::{Context, Surface};
use winit::application::ApplicationHandler;
use winit::dpi::{LogicalSize, PhysicalSize, Size};
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

use super::keys::{self, Action, Place};
use super::overlay::Canvas;
use super::{Seen, Viewer};
use crate::cli::run::fail;
use crate::error::{Error, counted};
use crate::load::seen;

/// The time between two looks at the files.
const POLL: Duration = Duration::from_millis(250);

/// The least time between two frames of a motion.
const FRAME: Duration = Duration::from_millis(16);

/// The time of a message.
const READ: Duration = Duration::from_secs(6);

/// A picture that takes longer is drawn as a draft while the camera moves.
const SLOW: Duration = Duration::from_millis(30);

/// The time without a move after which a draft is drawn in full.
const REST: Duration = Duration::from_millis(150);

/// Degrees of a turn by a drag across the height of the window.
const DRAG: f64 = 240.0;

const INK: [u8; 3] = [235; 3];
const ALARM: [u8; 3] = [255, 170, 90];

/// Shows the viewer until the window is closed. The display's scale multiplies its size if it `is_scaled`.
///
/// # Errors
/// There is no display, or the window cannot be drawn into.
pub(super) fn open(viewer: Viewer, is_scaled: bool) -> Result<(), Error> {
    let event_loop = EventLoop::new().map_err(|error| no_display(&error))?;
    let mut shown = Screen::new(viewer, is_scaled);
    event_loop.run_app(&mut shown).map_err(|error| no_display(&error))?;
    shown.outcome
}

/// An error with its cause, but without the line of a source file that it begins with.
fn no_display(error: &dyn std::fmt::Display) -> Error {
    let text = error.to_string();
    let cause = text.strip_prefix("os error at ").and_then(|text| text.split_once(": "));
    let cause = cause.map_or(&*text, |(_, cause)| cause).trim_end_matches('.');
    let error = Error::new(format!("no window ({cause})"), "a display").place("alberti view");
    error.hint("alberti render draws without one")
}

/// The pixels of a window.
type Target = Surface<Rc<Window>, Rc<Window>>;

/// A window with a viewer in it.
struct Screen {
    viewer: Viewer,
    is_scaled: bool,
    target: Option<(Rc<Window>, Target)>,
    picture: Option<Seen>,
    /// Whether the picture is no longer that of the viewer.
    is_old: bool,
    /// Whether it is a draft.
    is_draft: bool,
    /// The time that the picture took, and the one in full before it.
    took: Duration,
    whole: Duration,
    moved: Option<Instant>,
    /// The time from which a motion is to go on, if it plays, and what it takes to have a frame of it.
    played: Option<Instant>,
    staged: Duration,
    message: Option<(String, Instant)>,
    /// The error of the files, as long as they have it.
    fault: Option<String>,
    has_help: bool,
    has_text: bool,
    cursor: [f64; 2],
    held: Option<MouseButton>,
    shift: bool,
    /// Whether a key is held that makes other commands of letters.
    is_command: bool,
    /// Notches of the wheel since the last picture.
    notches: f64,
    looked: Instant,
    outcome: Result<(), Error>,
}

impl Screen {
    fn new(viewer: Viewer, is_scaled: bool) -> Self {
        Self {
            viewer,
            is_scaled,
            target: None,
            picture: None,
            is_old: true,
            is_draft: false,
            took: Duration::ZERO,
            whole: Duration::ZERO,
            moved: None,
            played: None,
            staged: Duration::ZERO,
            message: None,
            fault: None,
            has_help: false,
            has_text: true,
            cursor: [0.0; 2],
            held: None,
            shift: false,
            is_command: false,
            notches: 0.0,
            looked: Instant::now(),
            outcome: Ok(()),
        }
    }

    /// # Errors
    /// The system has no window.
    fn begin(&mut self, event_loop: &ActiveEventLoop) -> Result<(), Box<dyn std::error::Error>> {
        let [width, height] = self.viewer.size;
        let size: Size = match self.is_scaled {
            true => LogicalSize::new(width, height).into(),
            false => PhysicalSize::new(width, height).into(),
        };
        let attributes = Window::default_attributes()
            .with_title(format!("alberti: {}", self.viewer.name()))
            .with_inner_size(size);
        let window = Rc::new(event_loop.create_window(attributes)?);
        let context = Context::new(window.clone())?;
        let surface = Surface::new(&context, window.clone())?;
        window.request_redraw();
        self.target = Some((window, surface));
        Ok(())
    }

    fn end(&mut self, event_loop: &ActiveEventLoop, outcome: Result<(), Error>) {
        self.outcome = outcome;
        event_loop.exit();
    }

    /// Says something in the window.
    fn say(&mut self, text: String) {
        self.message = Some((text, Instant::now()));
        self.redraw();
    }

    /// Says an error in the window, and on standard error.
    fn hear<T>(&mut self, outcome: Result<T, Error>) -> Option<T> {
        match outcome {
            Ok(value) => Some(value),
            Err(error) => {
                fail(&error);
                self.say(error.to_string());
                None
            }
        }
    }

    /// Reads all files again. An error stays in the window until they are mended.
    fn reload(&mut self) {
        self.fault = self.viewer.reload().err().map(|error| {
            fail(&error);
            error.to_string()
        });
        self.is_old |= self.fault.is_none();
        self.message = None;
        self.redraw();
    }

    fn redraw(&self) {
        if let Some((window, _)) = &self.target {
            window.request_redraw();
        }
    }

    fn act(&mut self, action: Action, event_loop: &ActiveEventLoop) {
        match action {
            Action::Quit => return event_loop.exit(),
            Action::Help => (self.has_help, self.has_text) = (!self.has_help, true),
            Action::Text => self.has_text = !self.has_text,
            Action::Play if self.played.is_some() => self.played = None,
            Action::Play => self.play(0.0),
            Action::Step(_) => self.played = None,
            _ => {}
        }
        if matches!(action, Action::Turn(_) | Action::Pan(_) | Action::Zoom(..)) {
            self.moved = Some(Instant::now());
        }
        // The last message is about the picture before.
        self.message = None;
        if action == Action::Picture {
            let outcome = self.viewer.keep();
            if let Some(file) = self.hear(outcome) {
                self.say(format!("kept in {}", file.display()));
            }
        } else {
            let outcome = self.viewer.act(action);
            self.is_old |= self.hear(outcome) == Some(true);
        }
        self.redraw();
    }

    /// Has a motion go on, so many seconds later.
    fn play(&mut self, seconds: f64) {
        // The time that it takes to have the frame counts for the next.
        let now = Instant::now();
        // Once too slow, frames are in haste until the motion ends.
        let is_hasty = self.viewer.scene.is_coarse || self.staged > SLOW;
        let outcome = self.viewer.advance(seconds, is_hasty);
        self.staged = now.elapsed();
        self.played = self.hear(outcome).map(|_| now);
        (self.is_old, self.moved) = (true, Some(now));
    }

    /// Draws what is old, and shows the picture with the text over it.
    ///
    /// # Errors
    /// The window cannot be drawn into.
    fn show(&mut self) -> Result<(), Box<dyn std::error::Error>> {
        let Some((window, _)) = &self.target else { return Ok(()) };
        let PhysicalSize { width, height } = window.inner_size();
        let scale = if window.scale_factor() >= 1.5 { 2 } else { 1 };
        let (Some(columns), Some(rows)) = (NonZero::new(width), NonZero::new(height)) else { return Ok(()) };
        if [width, height] != self.viewer.size {
            let outcome = self.viewer.resize([width, height]);
            self.hear(outcome);
            self.is_old = true;
        }
        if self.is_old {
            let is_moving = self.moved.is_some_and(|moved| moved.elapsed() < REST);
            self.is_draft = is_moving && self.whole > SLOW;
            let begin = Instant::now();
            let outcome = self.viewer.picture(self.is_draft);
            if let Some(picture) = self.hear(outcome) {
                self.picture = Some(picture);
            }
            self.took = begin.elapsed();
            // Whether the whole is slow is known from it alone.
            if !self.is_draft {
                self.whole = self.took;
            }
            self.is_old = false;
        }
        let letters = Canvas::columns(width, scale);
        let lines = self.lines(letters);
        let message = self.message.as_ref().map(|(text, _)| text.clone()).or_else(|| self.fault.clone());
        let (help, text) = (self.has_help, self.has_text);
        let Some((window, surface)) = &mut self.target else { return Ok(()) };
        surface.resize(columns, rows)?;
        let mut pixels = surface.buffer_mut()?;
        match &self.picture {
            Some(Seen { image, .. }) if [image.width, image.height] == [width, height] => {
                for (k, (pixel, texel)) in pixels.iter_mut().zip(&image.texels).enumerate() {
                    *pixel = on_board(*texel, [k % image.width as usize, k / image.width as usize]);
                }
            }
            _ => pixels.fill(0),
        }
        let mut canvas = Canvas { pixels: &mut pixels, size: [width, height], scale };
        let mut row = 0;
        let mut write = |lines: &[String], color| {
            canvas.write(lines, row, color);
            row += lines.len() + 1;
        };
        if text {
            write(&lines, INK);
        }
        if let Some(message) = message {
            write(&wrapped(&message, letters), ALARM);
        }
        if text && help {
            write(&keys::list(), INK);
        }
        window.pre_present_notify();
        pixels.present()?;
        Ok(())
    }

    /// The text of the upper left corner.
    fn lines(&self, columns: usize) -> Vec<String> {
        let stats = self.picture.as_ref().map(|picture| picture.stats).unwrap_or_default();
        let took = self.took.as_secs_f64() * 1e3;
        let triangles = usize::try_from(stats.submitted).unwrap_or(usize::MAX);
        let mut line = format!("{}: {}", self.viewer.name(), counted(triangles, "triangle", "triangles"));
        if stats.fragments > 0 {
            line += &format!(", {} fragments", stats.fragments);
        }
        line += &format!(", {took:.1} ms");
        if self.played.is_some() {
            line += &format!(" and {:.1} ms for what moves", self.staged.as_secs_f64() * 1e3);
        }
        line += "   H: keys";
        if let Some([end, now]) = self.viewer.motion() {
            let does = if self.played.is_some() { "stands" } else { "plays" };
            line += &format!("   {now:.2} of {end:.2} s, Space: {does}");
        }
        let options = self.viewer.options().join(" ");
        let legend = self.picture.iter().flat_map(|picture| picture.legend.iter().cloned());
        let lines = [line, options].into_iter().filter(|line| !line.is_empty()).chain(legend);
        lines.flat_map(|line| wrapped(&line, columns)).collect()
    }

    fn key(&mut self, event: KeyEvent, event_loop: &ActiveEventLoop) {
        if event.state != ElementState::Pressed {
            return;
        }
        let action = match event.logical_key {
            Key::Named(NamedKey::Escape) => Some(Action::Quit),
            Key::Named(NamedKey::Tab) => Some(Action::Text),
            Key::Named(NamedKey::Home) => Some(Action::Fit),
            Key::Named(NamedKey::Space) => Some(Action::Play),
            Key::Named(NamedKey::ArrowLeft) => Some(keys::of_arrow([-1.0, 0.0], self.shift)),
            Key::Named(NamedKey::ArrowRight) => Some(keys::of_arrow([1.0, 0.0], self.shift)),
            Key::Named(NamedKey::ArrowUp) => Some(keys::of_arrow([0.0, 1.0], self.shift)),
            Key::Named(NamedKey::ArrowDown) => Some(keys::of_arrow([0.0, -1.0], self.shift)),
            Key::Character(letter) if !self.is_command => keys::of_letter(&letter, self.shift),
            _ => None,
        };
        if let Some(action) = action {
            self.act(action, event_loop);
        }
    }

    /// The mouse's place in the picture.
    fn place(&self) -> Place {
        let [width, height] = self.viewer.size.map(f64::from);
        let [x, y] = self.cursor;
        [(x - width / 2.0) / height.max(1.0), (height / 2.0 - y) / height.max(1.0)]
    }

    fn drag(&mut self, [x, y]: [f64; 2], event_loop: &ActiveEventLoop) {
        let [before_x, before_y] = std::mem::replace(&mut self.cursor, [x, y]);
        let height = f64::from(self.viewer.size[1]).max(1.0);
        // The thing goes with the mouse, the camera the other way.
        let moved = [(before_x - x) / height, (y - before_y) / height];
        match self.held {
            Some(MouseButton::Left) if !self.shift => {
                self.act(Action::Turn(moved.map(|share| share * DRAG)), event_loop);
            }
            Some(_) => self.act(Action::Pan(moved), event_loop),
            None => {}
        }
    }
}

/// A text in lines of so many columns, between words where that can be.
fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest: Vec<char> = text.chars().collect();
    while !rest.is_empty() && columns > 0 {
        let is_long = rest.len() > columns;
        let space = rest.iter().take(columns + 1).rposition(|c| *c == ' ').filter(|at| is_long && *at > 0);
        let next = rest.split_off(space.unwrap_or(columns).min(rest.len()));
        lines.push(rest.into_iter().collect());
        rest = next.into_iter().skip(usize::from(space.is_some())).collect();
    }
    lines
}

/// A pixel of the window: a colour over the squares that show through what is transparent.
fn on_board([red, green, blue, alpha]: [u8; 4], [x, y]: [usize; 2]) -> u32 {
    let square: u32 = if (x / 8 + y / 8).is_multiple_of(2) { 102 } else { 153 };
    let over = |color: u8| {
        let sum = u32::from(color) * u32::from(alpha) + square * u32::from(255 - alpha);
        u8::try_from(sum / 255).unwrap_or(u8::MAX)
    };
    u32::from_be_bytes([0, over(red), over(green), over(blue)])
}

impl ApplicationHandler for Screen {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if let Err(error) = self.begin(event_loop) {
            self.end(event_loop, Err(no_display(&error)));
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested => {
                if let Err(error) = self.show() {
                    let error = Error::new(format!("a window that cannot be drawn into ({error})"), "one");
                    self.end(event_loop, Err(error.place("alberti view")));
                }
            }
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => self.redraw(),
            WindowEvent::ModifiersChanged(modifiers) => {
                let state = modifiers.state();
                self.shift = state.shift_key();
                self.is_command = state.control_key() || state.alt_key() || state.super_key();
            }
            WindowEvent::KeyboardInput { event, .. } => self.key(event, event_loop),
            WindowEvent::CursorMoved { position, .. } => self.drag([position.x, position.y], event_loop),
            WindowEvent::MouseInput { state: ElementState::Pressed, button, .. } => self.held = Some(button),
            WindowEvent::MouseInput { state: ElementState::Released, .. } => self.held = None,
            WindowEvent::MouseWheel { delta, .. } => {
                self.notches += match delta {
                    MouseScrollDelta::LineDelta(_, y) => f64::from(y),
                    MouseScrollDelta::PixelDelta(by) => by.y / 40.0,
                };
            }
            WindowEvent::DroppedFile(path) => {
                let outcome = self.viewer.open(path);
                if self.hear(outcome).is_some() {
                    self.is_old = true;
                    if let Some((window, _)) = &self.target {
                        window.set_title(&format!("alberti: {}", self.viewer.name()));
                    }
                }
                self.redraw();
            }
            _ => {}
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        // All notches that have come are one move.
        let notches = std::mem::take(&mut self.notches);
        if notches != 0.0 {
            let at = self.place();
            self.act(Action::Zoom(keys::NEARER.powf(notches), Some(at)), event_loop);
        }
        let now = Instant::now();
        if let Some(before) = self.played {
            self.play((now - before).as_secs_f64());
            self.redraw();
        }
        if self.played.is_none() && self.viewer.scene.is_coarse {
            let outcome = self.viewer.stage_at_time(false);
            self.is_old |= self.hear(outcome).is_some();
            self.redraw();
        }
        if self.is_draft && self.moved.is_none_or(|moved| now - moved >= REST) {
            (self.is_old, self.is_draft) = (true, false);
            self.redraw();
        }
        if self.message.take_if(|(_, since)| now - *since >= READ).is_some() {
            self.redraw();
        }
        if now - self.looked >= POLL {
            self.looked = now;
            if seen::changed() {
                self.reload();
            }
        }
        let rest = self.moved.filter(|_| self.is_draft).map(|moved| moved + REST);
        let next = self.played.map(|_| now + FRAME).or(rest).unwrap_or(now + POLL).min(now + POLL);
        event_loop.set_control_flow(ControlFlow::WaitUntil(next));
    }
}

#[cfg(test)]
mod tests {
    use super::{on_board, wrapped};

    #[test]
    fn lines_end_between_words() {
        assert_eq!(wrapped("one of many words", 10), ["one of", "many words"]);
        assert_eq!(wrapped("a_word_that_is_long is", 8), ["a_word_t", "hat_is_l", "ong is"]);
        assert_eq!(wrapped("short", 10), ["short"]);
        assert_eq!(wrapped("none", 0), [""; 0]);
    }

    #[test]
    fn a_clear_background_shows_squares() {
        assert_eq!(on_board([1, 2, 3, 255], [5, 9]), 0x0001_0203);
        assert_eq!(
            [[0, 7], [8, 15], [9, 7]].map(|at| on_board([0; 4], at)),
            [0x66_6666, 0x66_6666, 0x99_9999]
        );
        assert_eq!(on_board([255, 0, 102, 128], [0, 0]), 0x00b2_3266);
    }
}
