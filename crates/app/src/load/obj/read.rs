//! An OBJ file as it streams in: blocks of lines, read by all cores and put together in the file's order.
//!
//! The text is never in memory as a whole, so a model takes no more than its numbers.

use std::collections::HashSet;
use std::path::Path;

use super::KIND;
use super::block::{Block, Event, Faces, Fault, UNDRAWN, WHITE};
use crate::error::{Error, counted};
use crate::load::input::Stream;
use crate::load::statements::not_text;
use crate::memory;
use crate::scene::Vertex;
use crate::threads::{Task, available, by_threads};

/// Bytes that a thread reads at a time.
const BLOCK: usize = 1 << 22;

/// Bytes that are read at a time where memory is short.
const SMALL: usize = 1 << 16;

/// The most bytes that one of text becomes: a short line is three indices or numbers, in lists that grow by halves.
const PARSED: u64 = 12;

/// The most threads that read.
const MAX_THREADS: usize = 16;

/// A name in the file, and the line where it comes first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Named {
    /// Trimmed.
    pub(crate) name: String,
    /// From 1.
    pub(crate) line: usize,
}

/// A file without errors.
#[derive(Clone, Debug, Default)]
pub(crate) struct ObjText {
    pub(crate) positions: Vec<[f64; 3]>,
    /// None, or one for each position; from 0 to 1.
    pub(crate) colors: Vec<[f32; 3]>,
    pub(crate) uvs: Vec<[f32; 2]>,
    pub(crate) normals: Vec<[f32; 3]>,
    /// In the file's order. All indices are in range.
    pub(crate) faces: Vec<Faces>,
    /// The arguments of `mtllib`, whole lines.
    pub(crate) libraries: Vec<Named>,
    /// The names that `usemtl` asks for, each once.
    pub(crate) materials: Vec<Named>,
    /// The number of face corners with a texture coordinate.
    pub(crate) corners_with_uv: usize,
    /// The number of colours that had to be clamped.
    pub(crate) colors_out_of_range: usize,
    undrawn: [usize; 4],
    /// The word of the first statement that the format has not, its line, and how many there are.
    unknown: Option<(String, usize, usize)>,
    no_numbers: Option<(usize, usize)>,
    /// The warnings of what was left out to read on.
    pub(crate) left_out: Vec<Error>,
    has_tables: bool,
    known: HashSet<String>,
    greatest: [u32; 3],
    huge: Option<String>,
    lines: usize,
}

const LINE_OF: [&str; 3] = ["v", "vt", "vn"];
const NAME_OF: [&str; 3] = ["vertex", "texture coordinate", "normal"];

impl ObjText {
    /// Reads a whole file. `path` is for messages; `progress` hears the bytes done, and how many there are.
    ///
    /// # Errors
    /// The first that a line has; then an index that the file does not reach.
    pub(crate) fn read(
        stream: &mut Stream,
        path: &Path,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<Self, Error> {
        let mut text = Self::default();
        let threads = available().get().min(MAX_THREADS);
        let (mut bytes, mut offset, mut ended) = (Vec::new(), 0, false);
        while !ended {
            let start = bytes.len();
            // The rest is of one line, which may be a long one.
            let block = usize::try_from(memory::left() / (4 * PARSED)).unwrap_or(usize::MAX);
            let wanted = (2 * start).max((threads * BLOCK).min(block).max(SMALL));
            ended = stream.fill(&mut bytes, wanted)?;
            if let Some(found) = not_text(&bytes[start..], offset) {
                return Err(Error::new(found, KIND).file(path).hint("export the model as OBJ text"));
            }
            offset += (bytes.len() - start) as u64;
            let end = if ended { bytes.len() } else { cut(&bytes) };
            // Lists grow by halves that stay empty.
            let read = 2 * text.bytes() + bytes.capacity() as u64 + PARSED * end as u64;
            memory::need(read, "a model").map_err(|error| error.file(path))?;
            let blocks = split(&bytes[..end], threads);
            for block in read_all(&blocks) {
                text.append(block).map_err(|error| error.file(path))?;
            }
            bytes.drain(..end);
            let (done, total) = stream.progress();
            progress(done, total);
        }
        text.check_indices().map_err(|error| error.file(path))?;
        text.leave_out();
        if text.faces.iter().all(|faces| faces.faces.is_empty()) {
            let mut found = format!("no faces in {}", counted(text.lines, "line", "lines"));
            let other = path.extension().is_some_and(|of| !of.eq_ignore_ascii_case("obj"));
            let hint = match text.undrawn() {
                Some(undrawn) => {
                    found = format!("nothing but {undrawn}");
                    "points, lines and curves are not drawn"
                }
                None if text.has_tables => "a scene file is told by its name, which ends in .toml",
                None if other => "export the model as OBJ",
                None => "check that this is the right file",
            };
            let error = Error::new(found, "an OBJ model with faces (lines like `f 1 2 3`)");
            return Err(error.file(path).hint(hint));
        }
        Ok(text)
    }

    /// The statements of things that are not drawn, in words.
    pub(crate) fn undrawn(&self) -> Option<String> {
        let kinds = self.undrawn.into_iter().zip(UNDRAWN).filter(|(count, _)| *count > 0);
        let words: Vec<_> = kinds.map(|(count, [one, many])| counted(count, one, many)).collect();
        (!words.is_empty()).then(|| words.join(" and "))
    }

    /// The warning of statements that the format has not.
    pub(crate) fn unknown(&self) -> Option<Error> {
        let (word, line, count) = self.unknown.as_ref()?;
        let more = if *count > 1 { format!(", the first of {count} such lines") } else { String::new() };
        let warning =
            Error::new(format!("{word}{more}"), "a statement of OBJ, such as `v`, `vt`, `vn` or `f`");
        Some(warning.line(*line).hint("left out"))
    }

    /// Bytes of all that has been read.
    pub(crate) fn bytes(&self) -> u64 {
        let faces = self.faces.iter().map(|faces| {
            size_of_val(&faces.corners[..]) + size_of_val(&faces.faces[..]) + 64 * faces.events.len()
        });
        let names = 64 * (self.libraries.len() + self.materials.len());
        let numbers = size_of_val(&self.positions[..])
            + size_of_val(&self.colors[..])
            + size_of_val(&self.uvs[..])
            + size_of_val(&self.normals[..]);
        (numbers + names + faces.sum::<usize>()) as u64
    }

    /// Bytes of the model that it becomes, while that is made, if each position is one vertex.
    pub(crate) fn bytes_of_model(&self) -> u64 {
        let vertices = self.counts().into_iter().max().unwrap_or(0);
        let corners: usize = self.faces.iter().map(|faces| faces.corners.len()).sum();
        let faces: usize = self.faces.iter().map(|faces| faces.faces.len()).sum();
        let triangles = corners.saturating_sub(2 * faces);
        // With their keys and companies. Lists grow by halves that stay empty.
        2 * (vertices * (size_of::<Vertex>() + 16) + triangles * 16) as u64
    }

    fn counts(&self) -> [usize; 3] {
        [self.positions.len(), self.uvs.len(), self.normals.len()]
    }

    fn append(&mut self, mut block: Block) -> Result<(), Error> {
        let (before, lines) = (self.counts(), self.lines);
        self.undrawn.iter_mut().zip(block.undrawn).for_each(|(sum, count)| *sum += count);
        self.has_tables |= block.has_tables;
        if let Some((word, line, count)) = block.unknown {
            self.unknown.get_or_insert((word, lines + line, 0)).2 += count;
        }
        if let Some((line, count)) = block.no_numbers {
            self.no_numbers.get_or_insert((lines + line, 0)).1 += count;
        }
        for relative in &block.relative {
            let (which, have) = (usize::from(relative.which), relative.have as usize);
            let index = (before[which] + have + 1).checked_sub(relative.back as usize).filter(|&i| i > 0);
            // A corner with a fault has not been kept.
            let corner = block.faces.corners.get_mut(relative.corner);
            match index.map(u32::try_from) {
                Some(Ok(index)) => corner.into_iter().for_each(|corner| corner[which] = index),
                _ => {
                    let line = block.faces.line_of(relative.corner);
                    let fault = block.fault.as_ref().map_or(0, |(line, _)| *line);
                    let error = out_of_range(&format!("-{}", relative.back), which, before[which] + have);
                    return Err(error.line(lines + line.unwrap_or(fault)));
                }
            }
        }
        if let Some((line, fault)) = block.fault {
            let error = match fault {
                Fault::Of(error) => error,
                Fault::Index(shown, which, have) => out_of_range(&shown, which, before[which] + have),
            };
            return Err(error.line(lines + line));
        }
        if !block.colors.is_empty() || !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), WHITE);
            self.colors.append(&mut block.colors);
            self.colors.resize(self.positions.len() + block.positions.len(), WHITE);
        }
        self.positions.append(&mut block.positions);
        self.uvs.append(&mut block.uvs);
        self.normals.append(&mut block.normals);
        let named = |(name, line)| Named { name, line: lines + line };
        self.libraries.extend(block.libraries.into_iter().map(named));
        for (_, event) in &block.faces.events {
            if let Event::Material(name, line) = event
                && !self.known.contains(name)
            {
                self.known.insert(name.clone());
                self.materials.push(Named { name: name.clone(), line: lines + line });
            }
        }
        self.corners_with_uv += block.corners_with_uv;
        self.colors_out_of_range += block.colors_out_of_range;
        self.greatest = [0, 1, 2].map(|which| self.greatest[which].max(block.greatest[which]));
        self.huge = self.huge.take().or(block.huge);
        self.lines += block.lines;
        // A file has fewer lines than 4 billion.
        let lines = u32::try_from(lines).unwrap_or(u32::MAX);
        block.faces.faces.iter_mut().for_each(|face| face.line = face.line.saturating_add(lines));
        block.faces.shrink();
        self.faces.push(block.faces);
        Ok(())
    }

    /// Refuses the first index that no line of the file has. Kinds of which the file has no line at all, but those of
    /// positions, pass.
    fn check_indices(&self) -> Result<(), Error> {
        let counts = self.counts();
        let beyond =
            |which: usize, index: u32| index as usize > counts[which] && (which == 0 || counts[which] > 0);
        if !(0..3).any(|which| beyond(which, self.greatest[which])) {
            return Ok(());
        }
        for faces in &self.faces {
            for (at, corner) in faces.corners.iter().enumerate() {
                let missing = corner.iter().enumerate().find(|&(which, &index)| beyond(which, index));
                if let Some((which, &index)) = missing {
                    let text = self.huge.clone().filter(|_| index == u32::MAX);
                    let text = text.unwrap_or_else(|| index.to_string());
                    let error = out_of_range(&text, which, counts[which]);
                    return Err(error.line(faces.line_of(at).unwrap_or_default()));
                }
            }
        }
        Ok(())
    }
}

impl ObjText {
    /// Forgets the indices of texture coordinates and normals if the file has none of these at all, and tells what was
    /// left out.
    fn leave_out(&mut self) {
        let counts = self.counts();
        if let Some((line, count)) = self.no_numbers {
            let found = match count {
                1 => "a normal or texture coordinates that are no numbers".to_owned(),
                _ => format!(
                    "{count} normals or texture coordinates that are no numbers, of which this is the first"
                ),
            };
            let error = Error::new(found, "finite numbers").line(line);
            self.left_out.push(error.hint("such normals are made, and such coordinates are 0"));
        }
        for which in [1, 2] {
            if counts[which] > 0 || self.greatest[which] == 0 {
                continue;
            }
            let mut first = None;
            for faces in &mut self.faces {
                let named = faces.corners.iter().position(|corner| corner[which] > 0);
                first = first.or_else(|| faces.line_of(named?));
                faces.corners.iter_mut().for_each(|corner| corner[which] = 0);
            }
            let (line_of, name) = (LINE_OF[which], NAME_OF[which]);
            let error =
                Error::new(format!("an index of a {name} in a face"), format!("`{line_of}` lines, or none"));
            self.left_out.push(
                error.line(first.unwrap_or_default()).hint("the file has no such lines; they are left out"),
            );
            if which == 1 {
                self.corners_with_uv = 0;
            }
        }
    }
}

impl Faces {
    /// The line of the face that has this corner.
    fn line_of(&self, corner: usize) -> Option<usize> {
        let mut end = 0;
        let face = self.faces.iter().find(|face| {
            end += face.corners as usize;
            corner < end
        });
        face.map(|face| face.line as usize)
    }

    fn shrink(&mut self) {
        self.corners.shrink_to_fit();
        self.faces.shrink_to_fit();
    }
}

fn out_of_range(shown: &str, which: usize, have: usize) -> Error {
    let (line_of, name) = (LINE_OF[which], NAME_OF[which]);
    let expected = match (have, shown.starts_with('-')) {
        (0, _) => format!("none, as the file gives no `{line_of}` lines before it"),
        (_, true) => format!("-1 to -{have} (`{line_of}` lines so far: {have})"),
        _ => format!("1 to {have} (`{line_of}` lines: {have})"),
    };
    Error::new(format!("{name} index {shown}"), expected).hint("indices count from 1; export the model again")
}

/// The blocks, each read by a thread of its own.
fn read_all(blocks: &[&[u8]]) -> Vec<Block> {
    let mut read: Vec<_> = blocks.iter().map(|_| Block::default()).collect();
    let work = read
        .iter_mut()
        .zip(blocks)
        .map(|(read, bytes)| -> Task<'_> { Box::new(move || *read = Block::read(bytes)) });
    by_threads(work.collect(), blocks.len());
    read
}

/// About equal blocks of whole lines, in order; none is empty.
fn split(bytes: &[u8], parts: usize) -> Vec<&[u8]> {
    let (mut rest, mut blocks) = (bytes, Vec::new());
    let size = (bytes.len() / parts).max(SMALL);
    while rest.len() > size {
        let end = match cut(&rest[..size]) {
            0 => cut(rest),
            end => end,
        };
        if end == 0 {
            break;
        }
        let (block, after) = rest.split_at(end);
        blocks.push(block);
        rest = after;
    }
    if !rest.is_empty() {
        blocks.push(rest);
    }
    blocks
}

/// The end of the last line that surely ends there and goes on in no other; 0 if there is none.
fn cut(bytes: &[u8]) -> usize {
    let mut end = bytes.len();
    while let Some(at) = bytes[..end].iter().rposition(|&b| b == b'\n' || b == b'\r') {
        // A CR at the very end may be half of a line's end.
        let whole = bytes[at] == b'\n' || bytes.get(at + 1).is_some_and(|&next| next != b'\n');
        // Space after the `\` does not count, and neither does the CR of this line's end.
        let line = bytes[..at].strip_suffix(b"\r").filter(|_| bytes[at] == b'\n').unwrap_or(&bytes[..at]);
        let last = line.iter().rfind(|byte| !matches!(byte, b' ' | b'\t' | b'\x0c'));
        if whole && last != Some(&b'\\') {
            return at + 1;
        }
        end = at;
    }
    0
}

#[cfg(test)]
mod tests;
