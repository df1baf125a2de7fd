//! Pictures and others into files: whole or not at all.

use std::fs;
use std::io::{self, Cursor, ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use image::codecs::pnm::{PnmEncoder, PnmSubtype, SampleEncoding};
use image::codecs::tga::TgaEncoder;
use image::{ExtendedColorType, ImageEncoder as _, ImageFormat};
use tempfile::NamedTempFile;

use crate::error::Error;
use crate::load::seen;
use crate::scene::Image;

const FORMATS: [(&str, ImageFormat); 8] = [
    ("png", ImageFormat::Png),
    ("jpg", ImageFormat::Jpeg),
    ("jpeg", ImageFormat::Jpeg),
    ("bmp", ImageFormat::Bmp),
    ("tga", ImageFormat::Tga),
    ("webp", ImageFormat::WebP),
    ("qoi", ImageFormat::Qoi),
    ("ppm", ImageFormat::Pnm),
];

/// The formats whose pixels have an alpha here.
const WITH_ALPHA: [ImageFormat; 4] =
    [ImageFormat::Png, ImageFormat::Tga, ImageFormat::WebP, ImageFormat::Qoi];

/// The name that stands for standard output.
pub(crate) const STANDARD: &str = "-";

/// Temporary files that may be there. Who has it makes files, or gives them their names; after a signal, nobody.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

pub(crate) fn temporary_files() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on SIGINT and SIGTERM, unless they are ignored, end the process as always, but remove temporary files
/// before. Files that belong together are either all replaced by then, or none. Other systems than Unix have no such
/// signals.
pub fn clean_up_on_signals() {
    #[cfg(unix)]
    {
        use signal_hook::consts::{SIGINT, SIGTERM};
        use signal_hook::iterator::Signals;
        use signal_hook::low_level::emulate_default_handler;

        // A file that grows beyond what is allowed is an error of writing then, and no end.
        _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
        // Without it, signals are what they were.
        let heeded = [SIGINT, SIGTERM].into_iter().filter(|&signal| !is_ignored(signal));
        let Ok(mut signals) = Signals::new(heeded) else { return };
        std::thread::spawn(move || {
            for signal in signals.forever() {
                let files = temporary_files();
                // Most of them are gone already. The last comes first, before the folder that it is in.
                files
                    .iter()
                    .rev()
                    .for_each(|file| _ = fs::remove_file(file).or_else(|_| fs::remove_dir(file)));
                let _ = emulate_default_handler(signal);
            }
        });
    }
}

/// Whether whoever started this process wants it to ignore a signal, as shells do with jobs in the background. Linux
/// tells; elsewhere, nothing is known of it.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}

/// A file that is written whole or not at all, and that can be written, as far as can be told before there is anything
/// to write.
#[derive(Clone, Debug)]
pub struct Whole {
    named: PathBuf,
    /// `named` with links followed: a link is written through, not replaced.
    path: PathBuf,
    /// The option that names it.
    option: &'static str,
}

impl Whole {
    /// Checks the folder, which need not be there, and the file that may be there already. Nothing is left behind.
    ///
    /// # Errors
    /// The file cannot be written: choose another with `option`.
    pub fn new(named: &Path, option: &'static str) -> Result<Self, Error> {
        let path = followed(named);
        let output = Self { named: named.to_owned(), path, option };
        if named.to_string_lossy().ends_with(std::path::is_separator) {
            return Err(output.refused("the name of a folder"));
        }
        if let Err(error) = fs::symlink_metadata(&output.path)
            && error.kind() != ErrorKind::NotFound
            && error.kind() != ErrorKind::NotADirectory
            && error.kind() != ErrorKind::PermissionDenied
        {
            return Err(output.refused(&format!("a name that no file can have ({error})")));
        }
        if let Ok(metadata) = fs::metadata(&output.path) {
            if metadata.is_dir() {
                return Err(output.refused("a directory"));
            }
            if !metadata.is_file() {
                return Err(output.refused("a device or a pipe"));
            }
            if metadata.permissions().readonly() {
                return Err(output.refused("a file that is read-only"));
            }
        }
        output.temporary()?;
        Ok(output)
    }

    /// The path as the user gave it, for messages.
    pub fn name(&self) -> &Path {
        &self.named
    }

    /// Whether `other` is the same file.
    pub fn is(&self, other: &Path) -> bool {
        fs::canonicalize(other).is_ok_and(|other| other == self.path)
    }

    /// Refuses a file that has been read, such as a texture.
    pub(crate) fn check_unread(&self) -> Result<(), Error> {
        if seen::any(|other| self.is(other)) { Err(seen::refused(&self.named, self.option)) } else { Ok(()) }
    }

    /// Writes these bytes. A failure at any point leaves whatever was there before.
    ///
    /// # Errors
    /// Writing fails: the disk is full, for example. Or the file has been read.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Error> {
        Self::write_all(&[(self, bytes)])
    }

    /// Writes several files that belong together: none is replaced before all are written.
    ///
    /// # Errors
    /// Writing one fails.
    pub fn write_all(files: &[(&Self, &[u8])]) -> Result<(), Error> {
        let written = files.iter().map(|(file, bytes)| file.written(bytes)).collect::<Result<Vec<_>, _>>()?;
        let _undisturbed = temporary_files();
        for ((file, _), new) in files.iter().zip(written) {
            file.make_folder()?;
            new.persist(&file.path)
                .map_err(|e| file.refused(&format!("that renaming fails ({})", e.error)))?;
        }
        Ok(())
    }

    /// A new file of these bytes, in or near the output's folder.
    fn written(&self, bytes: &[u8]) -> Result<NamedTempFile, Error> {
        self.check_unread()?;
        let mut file = self.temporary()?;
        file.write_all(bytes)
            .and_then(|()| match fs::metadata(&self.path) {
                // A file that is replaced keeps its permissions.
                Ok(old) => file.as_file().set_permissions(old.permissions()),
                Err(_) => Ok(()),
            })
            .and_then(|()| file.as_file().sync_all())
            .map_err(|e| self.refused(&format!("that writing fails ({})", cause(&e))))?;
        Ok(file)
    }

    /// Makes the output's folder, and those that it is in, where they are missing.
    fn make_folder(&self) -> Result<(), Error> {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        fs::create_dir_all(folder)
            .map_err(|error| self.refused(&format!("a folder that cannot be made ({error})")))
    }

    /// A new file, deleted when dropped, in the output's folder, or the nearest around it that is there.
    fn temporary(&self) -> Result<NamedTempFile, Error> {
        let mut around = self.path.ancestors().skip(1);
        let folder = around.find(|folder| folder.exists()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".alberti-");
        // As for any new file, not private as for most temporary ones.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut files = temporary_files();
        let file = builder.tempfile_in(folder).map_err(|error| {
            // Some folders are there, and answer that a new file is not: those of the system's own files.
            self.refused(&match (error.kind(), folder.is_dir()) {
                (ErrorKind::NotFound, true) => "a folder that takes no new files".to_owned(),
                (ErrorKind::NotADirectory, _) => "a file in the place of its folder".to_owned(),
                (ErrorKind::PermissionDenied, _) => "a folder that may not be written".to_owned(),
                _ => format!("a folder that cannot be written ({error})"),
            })
        })?;
        files.push(file.path().to_owned());
        Ok(file)
    }

    fn refused(&self, found: &str) -> Error {
        let hint = format!("choose another with {}", self.option);
        Error::new(found, "a file that can be written").file(&self.named).hint(hint)
    }
}

/// The file that a name stands for: links are followed, also to where nothing is yet.
fn followed(named: &Path) -> PathBuf {
    let mut path = named.to_owned();
    // As many as systems follow.
    for _ in 0..40 {
        let Ok(next) = fs::read_link(&path) else { break };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    fs::canonicalize(&path).unwrap_or(path)
}

/// A picture's file, or standard output.
#[derive(Clone, Debug)]
pub struct Output {
    named: PathBuf,
    sink: Sink,
    format: ImageFormat,
}

/// The way that a picture's bytes take.
#[derive(Clone, Debug)]
enum Sink {
    Standard,
    /// A device or a pipe, which nothing can be renamed to.
    Stream(PathBuf),
    File(Whole),
}

impl Output {
    /// Checks the extension, the folder and the file that may be there already. Nothing is left behind. The extension
    /// says the format, unless `format` names one as if it were an extension. `-` is standard output, which is PNG, and
    /// so are devices and pipes without an extension.
    ///
    /// # Errors
    /// The extension is unknown, or the file cannot be written.
    pub fn new(named: &Path, format: Option<&str>) -> Result<Self, Error> {
        let standard = named.as_os_str() == STANDARD;
        if named.is_dir() {
            let hint = format!("name a file in it, such as {}", named.join("picture.png").display());
            return Err(Error::new("a directory", "a file that can be written").file(named).hint(hint));
        }
        let extension = named.extension().map(|e| e.to_string_lossy().to_lowercase());
        let extension = format.map(str::to_owned).or(extension);
        let is_stream = fs::metadata(named).is_ok_and(|is| !is.is_file() && !is.is_dir());
        let extension = extension.or_else(|| (standard || is_stream).then(|| "png".to_owned()));
        let known = FORMATS.iter().find(|(name, _)| extension.as_deref() == Some(name));
        let &(_, format) = known.ok_or_else(|| {
            let hint = match extension.as_deref() {
                Some("gif" | "apng" | "mp4" | "mkv" | "webm" | "y4m") => {
                    "films are made by alberti turntable"
                }
                Some("exr") => "EXR files are of numbers: --aov depth --aov-format exr",
                _ => "name the output so, or give --output-format",
            };
            let found = extension.map_or("no extension".to_owned(), |e| format!("the extension \".{e}\""));
            let all = FORMATS.map(|(name, _)| format!(".{name}")).join(", ");
            Error::new(found, format!("one of {all}")).file(named).hint(hint)
        })?;
        let sink = match (standard, is_stream) {
            (true, _) => Sink::Standard,
            (_, true) => Sink::Stream(named.to_owned()),
            (..) => Sink::File(Whole::new(named, "-o")?),
        };
        Ok(Self { named: named.to_owned(), sink, format })
    }

    /// Whether a name has the extension of a picture.
    pub(crate) fn is_format_of(named: &Path) -> bool {
        let extension = named.extension().map(|e| e.to_string_lossy().to_lowercase());
        FORMATS.iter().any(|(name, _)| extension.as_deref() == Some(name))
    }

    /// The path as the user gave it, for messages.
    pub fn name(&self) -> &Path {
        &self.named
    }

    /// Whether it is standard output.
    pub fn is_standard(&self) -> bool {
        matches!(self.sink, Sink::Standard)
    }

    /// Whether it is a file, beside which others can be.
    pub fn is_file(&self) -> bool {
        matches!(self.sink, Sink::File(_))
    }

    /// Whether `other` is the same file.
    pub fn is(&self, other: &Path) -> bool {
        matches!(&self.sink, Sink::File(file) if file.is(other))
    }

    /// The same of a picture, if it is a file.
    pub(crate) fn check_unread(&self) -> Result<(), Error> {
        if let Sink::File(file) = &self.sink { file.check_unread() } else { Ok(()) }
    }

    /// # Errors
    /// Its format has no alpha.
    pub fn check_alpha(&self) -> Result<(), Error> {
        if WITH_ALPHA.contains(&self.format) {
            return Ok(());
        }
        let error = Error::new("a format without transparency", "png, tga, webp or qoi").file(&self.named);
        Err(error.hint("choose another with -o, or another --background"))
    }

    /// Encodes and writes the picture, without its alpha. A failure at any point leaves whatever was there before.
    ///
    /// # Errors
    /// Encoding or writing fails: the disk is full, for example.
    pub fn write(&self, picture: &Image) -> Result<(), Error> {
        self.write_beside(&self.encoded(picture, false)?, &[])
    }

    /// The same with its alpha.
    ///
    /// # Errors
    /// Those of [`write`](Self::write), and of [`check_alpha`](Self::check_alpha).
    pub fn write_with_alpha(&self, picture: &Image) -> Result<(), Error> {
        self.write_beside(&self.encoded(picture, true)?, &[])
    }

    /// The bytes of the picture's file, with or without its alpha.
    ///
    /// # Errors
    /// Encoding fails, or the format has no alpha.
    pub fn encoded(&self, picture: &Image, alpha: bool) -> Result<Vec<u8>, Error> {
        if alpha {
            self.check_alpha()?;
            return self.encode(picture, picture.texels.as_flattened(), ExtendedColorType::Rgba8);
        }
        let rgb: Vec<u8> = picture.texels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        self.encode(picture, &rgb, ExtendedColorType::Rgb8)
    }

    fn encode(&self, picture: &Image, bytes: &[u8], colors: ExtendedColorType) -> Result<Vec<u8>, Error> {
        // Encoded in memory first, so that there is a temporary file only for as long as a copy takes.
        let mut encoded = Cursor::new(Vec::new());
        let (width, height) = (picture.width, picture.height);
        let written = match self.format {
            ImageFormat::Pnm => {
                // P6: the kind that all programs read.
                let encoder = PnmEncoder::new(&mut encoded);
                let encoder = encoder.with_subtype(PnmSubtype::Pixmap(SampleEncoding::Binary));
                encoder.write_image(bytes, width, height, colors)
            }
            // Its runs would go on from row to row, which not all programs read.
            ImageFormat::Tga => {
                TgaEncoder::new(&mut encoded).disable_rle().write_image(bytes, width, height, colors)
            }
            format => image::write_buffer_with_format(&mut encoded, bytes, width, height, colors, format),
        };
        written.map_err(|error| {
            let found = format!("that encoding fails ({error})");
            Error::new(found, "a picture of another size or format").file(&self.named)
        })?;
        Ok(encoded.into_inner())
    }

    /// Writes the bytes of the picture, and other files that belong to it: none is replaced before all are written.
    ///
    /// # Errors
    /// Writing one fails.
    pub fn write_beside(&self, encoded: &[u8], others: &[(&Whole, Vec<u8>)]) -> Result<(), Error> {
        let file = match &self.sink {
            Sink::File(file) => file,
            Sink::Standard => return write_stream(&mut io::stdout().lock(), encoded, "standard output"),
            Sink::Stream(path) => {
                let place = path.display().to_string();
                let mut stream = fs::OpenOptions::new().write(true).open(path);
                let mut stream = stream.as_mut().map_err(|error| unwritten(error, &place))?;
                return write_stream(&mut stream, encoded, &place);
            }
        };
        let others = others.iter().map(|(other, bytes)| (*other, &bytes[..]));
        Whole::write_all(&[(file, encoded)].into_iter().chain(others).collect::<Vec<_>>())
    }
}

/// # Errors
/// Nobody reads it.
fn write_stream(out: &mut dyn io::Write, bytes: &[u8], place: &str) -> Result<(), Error> {
    out.write_all(bytes).and_then(|()| out.flush()).map_err(|error| unwritten(&error, place))
}

/// An error without the name of a temporary file.
fn cause(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" at path ").next().unwrap_or_default().to_owned()
}

fn unwritten(error: &io::Error, place: &str) -> Error {
    Error::new(format!("that writing fails ({})", cause(error)), "to write the picture").place(place)
}

#[cfg(test)]
mod tests;
