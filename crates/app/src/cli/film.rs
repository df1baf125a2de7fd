//! The file of a film, or those of its frames.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::error::{Error, quote};
use crate::film::format::{Film, Format};
use crate::film::names::Names;
use crate::film::rate::Rate;
use crate::output::file::{Output, Whole, temporary_files};
use crate::scene::Image;

/// The program that encodes what films are commonly sent as.
const ENCODER: &str = "ffmpeg";

/// Pictures that may be missing between others without being told.
const GAP: u32 = 10_000;

/// Pictures may begin with a number up to this.
const FIRST: u32 = 1000;

/// The way that a film's frames take.
#[derive(Debug)]
pub(super) enum FilmFile {
    Whole(Whole, Format),
    Frames(Names),
}

impl FilmFile {
    /// Checks the name. `whole` has a file that can be written.
    ///
    /// # Errors
    /// The extension is of no film, or the file cannot be written.
    pub(super) fn new(
        named: &Path,
        whole: impl FnOnce(&Path) -> Result<Whole, Error>,
    ) -> Result<Self, Error> {
        let extension = named.extension().map(|extension| extension.to_string_lossy().into_owned());
        let format = extension.as_deref().and_then(Format::of);
        let expected = "pictures such as frames/%04d.png, or one film such as spin.gif";
        if let Some(names) = Names::of(named) {
            if format.is_some() && !Output::is_format_of(named) {
                return Err(Error::new("a film with a number in its name", expected).file(named));
            }
            Output::new(&names.name(0), None)?;
            return Ok(Self::Frames(names));
        }
        if named.ancestors().skip(1).any(|folder| Names::of(folder).is_some()) {
            return Err(Error::new("a number in the name of a folder", expected).file(named));
        }
        if named == Path::new("-") {
            let error = Error::new("standard output", "a file, as films are written whole").place("-o");
            return Err(error);
        }
        let format = format.ok_or_else(|| {
            let found = extension.map_or("no extension".to_owned(), |e| format!("the extension \".{e}\""));
            let expected = format!("one of {}, or pictures such as frames/%04d.png", Format::extensions());
            Error::new(found, expected).file(named).hint("name the film so with -o")
        })?;
        if let Format::Encoded(_) = format {
            let found =
                Command::new(ENCODER).arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status();
            found.map_err(|_| {
                let found = format!("no {ENCODER}, which encodes such films");
                Error::new(found, "it installed, or a gif, png or webp").file(named)
            })?;
        }
        Ok(Self::Whole(whole(named)?, format))
    }

    /// The warning of frames that are too fast for a format, if they are.
    pub(super) fn too_fast(&self, fps: Rate) -> Option<Error> {
        let Self::Whole(file, Format::Gif) = self else { return None };
        let found = format!("{fps} frames a second");
        let error = Error::new(found, "at most 50 in a GIF, which viewers show").file(file.name());
        fps.is_above(50).then(|| error.hint("they show others slowly: take webp or png"))
    }

    /// # Errors
    /// Its format has no alpha.
    pub(super) fn check_alpha(&self) -> Result<(), Error> {
        match self {
            Self::Whole(file, format) if !format.has_alpha() => {
                let error = Error::new("a format without transparency", "gif, png or webp").file(file.name());
                Err(error.hint("choose another with -o, or another --background"))
            }
            Self::Whole(..) => Ok(()),
            Self::Frames(names) => Output::new(&names.name(0), None)?.check_alpha(),
        }
    }

    /// Whether a frame is there already, as a picture of that size.
    pub(super) fn has(&self, frame: u32, size: (u32, u32)) -> bool {
        matches!(self, Self::Frames(names) if image::image_dimensions(names.name(frame)).is_ok_and(|of| of == size))
    }

    /// A film of so many frames, and so many a second, if this is one file.
    pub(super) fn film(&self, (frames, rate): (u32, Rate), alpha: bool) -> Option<Film> {
        match self {
            Self::Whole(_, format) => Some(Film::new(*format, (frames, rate), alpha)),
            Self::Frames(..) => None,
        }
    }

    /// Writes a frame into its own file.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn write_frame(&self, frame: u32, image: &Image, alpha: bool) -> Result<(), Error> {
        let Self::Frames(names) = self else { return Ok(()) };
        let output = Output::new(&names.name(frame), None)?;
        if alpha { output.write_with_alpha(image) } else { output.write(image) }
    }

    /// Writes the film.
    ///
    /// # Errors
    /// It cannot be encoded or written.
    pub(super) fn write(&self, film: Film) -> Result<(), Error> {
        let Self::Whole(file, format) = self else { return Ok(()) };
        let bytes = film.finish().map_err(|error| error.file(file.name()))?;
        match format {
            Format::Encoded(muxer) => file.write(&encoded(&bytes, muxer, file.name())?),
            _ => file.write(&bytes),
        }
    }
}

/// The file that the encoder makes of a stream of pictures.
fn encoded(stream: &[u8], muxer: &str, name: &Path) -> Result<Vec<u8>, Error> {
    let failed = |why: &str| {
        let found = format!("that {ENCODER} fails ({})", quote(why.trim().as_bytes()));
        Error::new(found, "a film that it encodes, of an even width and height").file(name)
    };
    let folder = tempfile::tempdir().map_err(|error| failed(&error.to_string()))?;
    let (file, words) = (folder.path().join("film"), ["-hide_banner", "-loglevel", "error", "-y"]);
    temporary_files().extend([folder.path().to_owned(), file.clone()]);
    let mut child = Command::new(ENCODER)
        .args(words)
        .args(["-f", "yuv4mpegpipe", "-i", "-", "-pix_fmt", "yuv420p", "-colorspace", "bt709"])
        .args(["-color_primaries", "bt709", "-color_trc", "iec61966-2-1"])
        // Edges stay sharp, as those of the pictures are.
        .args(["-crf", "18", "-b:v", "0", "-f", muxer])
        .arg(&file)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| failed(&error.to_string()))?;
    // If it ends before it has read everything, it says why.
    let _ = child.stdin.take().map(|mut stdin| stdin.write_all(stream));
    let ended = child.wait_with_output().map_err(|error| failed(&error.to_string()))?;
    if !ended.status.success() {
        let said = String::from_utf8_lossy(&ended.stderr).into_owned();
        return Err(failed(said.lines().last().unwrap_or("without a word")));
    }
    fs::read(&file).map_err(|error| failed(&error.to_string()))
}

/// The pictures of these names that are there, and the number of the first.
///
/// # Errors
/// There is none, or one is missing between others.
pub(super) fn pictures(named: &Path) -> Result<(Vec<PathBuf>, u32), Error> {
    let names = Names::of(named).ok_or_else(|| {
        let error = Error::new("a name without a number", "one for all pictures, such as frames/%04d.png");
        error.file(named)
    })?;
    let first = (0..=FIRST).find(|&frame| names.name(frame).exists());
    let first = first.ok_or_else(|| {
        Error::new("no picture", format!("one from {} on", names.name(0).display())).file(named)
    })?;
    let all: Vec<_> = (first..).map(|frame| names.name(frame)).take_while(|path| path.exists()).collect();
    let end = first + u32::try_from(all.len()).unwrap_or(u32::MAX);
    match (end..end.saturating_add(GAP)).map(|frame| names.name(frame)).find(|path| path.exists()) {
        Some(later) => {
            let expected = format!("all up to the last, since {} is there", later.display());
            Err(Error::new("no such picture", expected).file(&names.name(end)))
        }
        None => Ok((all, first)),
    }
}
