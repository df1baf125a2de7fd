//! Formats of films, each of which takes frames one by one.

use std::cell::RefCell;
use std::io::{self, Write};
use std::rc::Rc;

use super::palette::Palette;
use super::rate::Rate;
use super::{webp, y4m};
use crate::error::Error;
use crate::memory;
use crate::scene::Image;

/// A format of films.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// 256 colours, one of which may be clear.
    Gif,
    /// Animated PNG.
    Apng,
    /// Animated WebP, without loss.
    WebP,
    /// Uncompressed, for other programs.
    Y4m,
    /// That by way of ffmpeg, by the name of its muxer.
    Encoded(&'static str),
}

/// Extensions and formats.
const NAMES: [(&str, Format); 8] = [
    ("gif", Format::Gif),
    ("png", Format::Apng),
    ("apng", Format::Apng),
    ("webp", Format::WebP),
    ("y4m", Format::Y4m),
    ("mp4", Format::Encoded("mp4")),
    ("mkv", Format::Encoded("matroska")),
    ("webm", Format::Encoded("webm")),
];

impl Format {
    /// The format of an extension, in any case.
    pub(crate) fn of(extension: &str) -> Option<Self> {
        let known = NAMES.into_iter().find(|(name, _)| name.eq_ignore_ascii_case(extension));
        known.map(|(_, format)| format)
    }

    /// All extensions, in words.
    pub(crate) fn extensions() -> String {
        NAMES.map(|(name, _)| format!(".{name}")).join(", ")
    }

    /// Whether it can show what is behind it.
    pub(crate) fn has_alpha(self) -> bool {
        matches!(self, Self::Gif | Self::Apng | Self::WebP)
    }

    /// Bytes of memory for each pixel of each frame, beside the file.
    pub(crate) fn kept(self) -> u64 {
        match self {
            // All frames are seen before the first is written.
            Self::Gif => 5,
            Self::Apng | Self::WebP => 2,
            Self::Y4m | Self::Encoded(_) => 3,
        }
    }
}

/// A film that is being encoded.
pub(crate) struct Film {
    format: Format,
    /// Frames in all, and a second.
    frames: u32,
    rate: Rate,
    /// Whether alpha counts.
    alpha: bool,
    /// Frames so far.
    count: u32,
    state: State,
}

enum State {
    /// Before the first frame.
    Empty,
    Kept(Vec<Image>, bool),
    Apng(png::Writer<Shared>, Shared, bool),
    Bytes(Vec<u8>),
}

/// Bytes that a writer keeps for itself otherwise.
#[derive(Clone, Default)]
struct Shared(Rc<RefCell<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Film {
    /// A film of so many frames, so many of them a second, with alpha where the format has one.
    pub(crate) fn new(format: Format, (frames, rate): (u32, Rate), alpha: bool) -> Self {
        Self { format, frames, rate, alpha: alpha && format.has_alpha(), count: 0, state: State::Empty }
    }

    /// Appends a frame. The first says the size.
    ///
    /// # Errors
    /// It cannot be encoded, or memory is short.
    pub(crate) fn push(&mut self, frame: Image) -> Result<(), Error> {
        if matches!(self.state, State::Empty) {
            self.state = self.begun(&frame)?;
        }
        let duration = self.rate.parts(self.count + 1, 1000) - self.rate.parts(self.count, 1000);
        self.count += 1;
        match &mut self.state {
            State::Empty => {}
            State::Kept(frames, _) => frames.push(frame),
            State::Apng(writer, _, alpha) => {
                let written = if *alpha {
                    writer.write_image_data(frame.texels.as_flattened())
                } else {
                    writer.write_image_data(&opaque(&frame))
                };
                written.map_err(|error| refused(&error))?;
            }
            State::Bytes(bytes) if self.format == Format::WebP => webp::push(bytes, &frame, duration)?,
            State::Bytes(bytes) => y4m::push(bytes, &frame),
        }
        Ok(())
    }

    /// The file.
    ///
    /// # Errors
    /// It cannot be encoded.
    pub(crate) fn finish(self) -> Result<Vec<u8>, Error> {
        match self.state {
            State::Empty => Ok(Vec::new()),
            State::Kept(ref frames, alpha) => self.gif(frames, alpha).map_err(|error| refused(&error))?,
            State::Apng(writer, bytes, _) => {
                writer.finish().map_err(|error| refused(&error))?;
                Ok(bytes.0.take())
            }
            State::Bytes(bytes) if self.format == Format::WebP => webp::finish(bytes),
            State::Bytes(bytes) => Ok(bytes),
        }
    }

    /// Asks for the memory that frames of a size take, before there is one.
    ///
    /// # Errors
    /// There is less, or the format has no such size.
    pub(crate) fn need(&self, [width, height]: [u32; 2]) -> Result<(), Error> {
        if matches!(self.format, Format::Encoded(_)) && (width | height) % 2 == 1 {
            let found = format!("{width}x{height}");
            return Err(Error::new(found, "an even width and height for such a film").place("--size"));
        }
        let pixels = u64::from(width) * u64::from(height) * u64::from(self.frames);
        let what = format!("a film of {} frames", self.frames);
        memory::need(self.format.kept() * pixels, what).map_err(|error| error.place("--frames"))
    }

    fn begun(&self, first: &Image) -> Result<State, Error> {
        let size = [first.width, first.height];
        self.need(size)?;
        let alpha = self.alpha;
        Ok(match self.format {
            Format::Gif => State::Kept(Vec::new(), alpha),
            Format::Apng => {
                let bytes = Shared::default();
                let mut encoder = png::Encoder::new(bytes.clone(), size[0], size[1]);
                encoder.set_color(if alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
                let Rate { frames, seconds } = self.rate;
                let writer = encoder
                    .set_animated(self.frames, 0)
                    .and_then(|()| encoder.set_frame_delay(seconds, frames))
                    .and_then(|()| encoder.write_header());
                State::Apng(writer.map_err(|error| refused(&error))?, bytes, alpha)
            }
            Format::WebP => State::Bytes(webp::header(size, alpha)),
            Format::Y4m | Format::Encoded(_) => State::Bytes(y4m::header(size, self.rate)),
        })
    }

    /// All frames in one palette; of each the rectangle that differs from the one before.
    fn gif(&self, frames: &[Image], alpha: bool) -> Result<Result<Vec<u8>, Error>, gif::EncodingError> {
        let palette = match Palette::new(frames, alpha) {
            Ok(palette) => palette,
            Err(error) => return Ok(Err(error)),
        };
        let side = |side: u32| u16::try_from(side).unwrap_or(u16::MAX);
        let (width, height) = frames.first().map_or((0, 0), |frame| (side(frame.width), side(frame.height)));
        let mut encoder = gif::Encoder::new(Vec::new(), width, height, &palette.bytes())?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        let mut before: Option<Vec<u8>> = None;
        for (frame, number) in frames.iter().zip(0..) {
            let indices = palette.indices(frame);
            let delay = self.rate.parts(number + 1, 100) - self.rate.parts(number, 100);
            let all = [0, 0, width, height];
            // Clear pixels would show the frame before.
            let [left, top, right, bottom] = match &before {
                Some(before) if !alpha => changed(before, &indices, width).unwrap_or([0, 0, 1, 1]),
                _ => all,
            };
            let rows = indices.chunks(width.max(1).into()).skip(top.into()).take((bottom - top).into());
            let buffer: Vec<u8> = rows.flat_map(|row| &row[left.into()..right.into()]).copied().collect();
            encoder.write_frame(&gif::Frame {
                left,
                top,
                width: right - left,
                height: bottom - top,
                delay: u16::try_from(delay).unwrap_or(u16::MAX),
                dispose: if alpha { gif::DisposalMethod::Background } else { gif::DisposalMethod::Keep },
                transparent: palette.clear,
                buffer: buffer.into(),
                ..gif::Frame::default()
            })?;
            before = Some(indices);
        }
        encoder.into_inner().map(Ok)
    }
}

/// The least rectangle outside which two pictures are equal: left, top, right, bottom. None if they are.
fn changed(a: &[u8], b: &[u8], width: u16) -> Option<[u16; 4]> {
    let width = usize::from(width.max(1));
    let rows = || a.chunks(width).zip(b.chunks(width)).enumerate().filter(|(_, (a, b))| a != b);
    let (top, bottom) = (rows().next()?.0, rows().next_back()?.0 + 1);
    let columns = rows().map(|(_, (a, b))| {
        let differs = |k: &usize| a[*k] != b[*k];
        ((0..a.len()).find(differs).unwrap_or(0), (0..a.len()).rfind(differs).unwrap_or(0) + 1)
    });
    let (left, right) = columns.fold((width, 0), |(left, right), (l, r)| (left.min(l), right.max(r)));
    Some([left, top, right, bottom].map(|side| u16::try_from(side).unwrap_or(u16::MAX)))
}

/// Red, green and blue of all pixels.
fn opaque(frame: &Image) -> Vec<u8> {
    frame.texels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
}

fn refused(error: &dyn std::error::Error) -> Error {
    Error::new(format!("that encoding fails ({error})"), "frames of another size, or another format")
}
