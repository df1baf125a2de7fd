//! `alberti turntable`: a film of a model that turns, and `alberti assemble`: a film of pictures.

use std::borrow::Cow;
use std::env;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command, FromArgMatches as _};

use super::RenderArgs;
use super::film::{FilmFile, pictures};
use super::picture::warn_of_frames_below;
use super::request::{Request, hidden, refuse};
use super::run::print;
use super::staged::{Cast, Staged, projection, threads};
use super::told::{forget, warn};
use crate::error::{Error, counted};
use crate::film::format::Format;
use crate::film::names::Shard;
use crate::film::rate::Rate;
use crate::film::{EARLY, Set, Shot, ordered};
use crate::load::image_file;
use crate::load::scene_file::SceneFile;
use crate::memory;
use crate::options::values::{Finite, Number, Point, Size};
use crate::options::{Background, DEFAULT_SIZE, upwards};
use crate::output::file::Whole;
use crate::output::stage::{self, Stage, during, is_silent};
use crate::scene::Camera;
use crate::scene::camera::{self, Sight, Turn};
use crate::scene::ground::Shadows;

pub(super) const HELP: &str = "\
Examples:
  alberti turntable teapot.obj                       60 frames into alberti.gif
  alberti turntable cow.obj --texture cow.png -o cow.webp --frames 90 --ground
  alberti turntable wet.toml -o wet.mp4 --degrees -360
  alberti turntable cow.obj -o frames/%04d.png --shard 0/4    and 1/4, 2/4, 3/4 elsewhere; then
  alberti assemble frames/%04d.png -o cow.gif";

/// The heading of its own options.
const OWN: &str = "Film";

/// The film that is written where none is named.
const DEFAULT: &str = "alberti.gif";

/// Options of pictures that films have not.
const NOT_OF_FILMS: [&str; 6] = ["output_format", "aov", "aov_format", "stats", "show", "time"];

/// The greatest number of frames.
const MOST: u32 = 100_000;

/// The options of `alberti turntable`: those of `render`, and these.
#[derive(Clone, Debug, Args)]
pub struct TurntableArgs {
    /// The scene, as `render` takes it. The extension of --output says what the film is, a name with %04d that it is
    /// pictures, one for each frame.
    #[command(flatten)]
    pub render: RenderArgs,

    /// Frames of the turn, or of the whole motion of a scene file [default: 60, or as many as that takes]. With --fps,
    /// the first ones of the motion.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = frames)]
    #[arg(help_heading = OWN)]
    pub frames: Option<u32>,

    /// Frames a second, such as 24 or 29.97.
    #[arg(long, value_name = "N", default_value = "30", allow_hyphen_values = true, help_heading = OWN)]
    pub fps: Rate,

    /// Degrees that the camera goes to the right in all [default: 360, or 0 where a scene file moves something].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, help_heading = OWN)]
    pub degrees: Option<Number<Finite>>,

    /// The axis of the turn, through the target: a direction, or the name of one such as z [default: that of --up].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, help_heading = OWN, value_parser = upwards)]
    pub axis: Option<Point>,

    /// Draw one of N shares of the pictures, those that are not there yet: K/N with K from 0 on.
    ///
    /// The default is that of a task of a Slurm array. /N has the index of a Kubernetes Indexed Job.
    #[arg(long, value_name = "K/N", allow_hyphen_values = true, help_heading = OWN)]
    pub shard: Option<Shard>,
}

fn frames(text: &str) -> Result<u32, String> {
    let number = text.parse().ok().filter(|number| (1..=MOST).contains(number));
    number.ok_or_else(|| format!("a whole number from 1 to {MOST}"))
}

/// The command without options of pictures in its help.
pub(super) fn without_pictures(command: Command) -> Command {
    let output = format!(
        "Film to write; the extension says the format: {}. A name with %04d is that of pictures, one for each frame [default: {DEFAULT}]",
        Format::extensions()
    );
    hidden(command, &NOT_OF_FILMS)
        .mut_arg("output", |option| option.help(output.clone()).long_help(output).help_heading(OWN))
}

/// Draws a film.
pub(super) fn run(matches: &ArgMatches) -> Result<(), Error> {
    let arguments = TurntableArgs::from_arg_matches(matches)
        .map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    let request = Request::read(matches)?;
    refuse(matches, "turntable", &NOT_OF_FILMS, "a film is written")?;
    // A scene file's output is a picture.
    let is_given = matches.value_source("output") == Some(ValueSource::CommandLine);
    let output = request.arguments.render.output.clone().filter(|_| is_given);
    let output = output.as_deref().unwrap_or(Path::new(DEFAULT));
    film(&arguments, (&request, matches), output).map_err(|error| request.relocate(error))
}

fn film(
    arguments: &TurntableArgs,
    (request, matches): (&Request, &ArgMatches),
    output: &Path,
) -> Result<(), Error> {
    stage::begin();
    forget();
    request.check()?;
    if arguments.axis.is_some_and(|axis| <[f32; 3]>::from(axis) == [0.0; 3]) {
        return Err(Error::new("no direction", "one, such as 0,1,0").place("--axis"));
    }
    let share = match arguments.shard {
        Some(shard) => Some(shard),
        None => Shard::of_job(&|name| env::var(name).ok())?,
    };
    let shard = share.unwrap_or(Shard::ALL);
    let end = request.file.as_ref().and_then(SceneFile::end);
    // A motion that does not end as it began is shown up to its end; of a round the first frame comes after the last.
    let last = u32::from(request.file.as_ref().is_some_and(|file| end.is_some() && !file.goes_round()));
    let lasting = |end| arguments.fps.lasting(end, MOST + 1) + last;
    let frames = arguments.frames.unwrap_or_else(|| end.map_or(60, lasting));
    if frames > MOST {
        let found = format!("a motion of more than {MOST} frames");
        return Err(Error::new(found, "fewer").place("--fps").hint("see --frames and --fps"));
    }
    let stands = arguments.degrees.map_or(end.is_some(), |degrees| <[f64; 1]>::from(degrees)[0] == 0.0);
    if arguments.axis.is_some() && stands {
        let error = Error::new("it for a camera that does not turn", "--degrees of a turn").place("--axis");
        warn(&error.hint("it has no effect").to_string());
    }
    let is_timed = matches.value_source("fps") == Some(ValueSource::CommandLine);
    // Frames without a rate are all of a motion.
    let whole_motion = end.filter(|_| arguments.frames.is_some() && !is_timed);
    let steps = (frames - last.min(frames - 1)).max(1);
    let fps = whole_motion.map_or(arguments.fps, |end| Rate::of(steps, end));
    let time = |frame: u32| match whole_motion {
        Some(end) => end * f64::from(frame) / f64::from(steps),
        None => fps.time(frame),
    };
    let file = FilmFile::new(output, |path| request.whole(path, "-o"))?;
    file.too_fast(fps).iter().for_each(|warning| warn(&warning.to_string()));
    let transparent = request.arguments.render.background == Some(Background::Transparent);
    if transparent {
        file.check_alpha()?;
    }
    let range = match &file {
        FilmFile::Frames(..) => shard.frames(frames),
        FilmFile::Whole(..) if arguments.shard.is_some() && shard.is_part() => {
            let error = Error::new("a share of a film in one file", "pictures, such as -o frames/%04d.png");
            return Err(error.place("--shard").hint("alberti assemble joins them"));
        }
        FilmFile::Whole(..) => 0..frames,
    };
    let Size(width, height) = request.arguments.render.size.unwrap_or(DEFAULT_SIZE);
    let (there, wanted): (Vec<u32>, Vec<u32>) =
        range.partition(|&frame| share.is_some() && file.has(frame, (width, height)));
    if share.is_none() && file.has(frames, (width, height)) {
        let FilmFile::Frames(names) = &file else { return Err(Error::new("no pictures", "some")) };
        let error = Error::new("a picture of a longer film", "none after the last").file(&names.name(frames));
        warn(&error.hint("alberti assemble would join it").to_string());
    }
    request.hold_film(transparent)?;
    // Things that are loaded are kept for frames that are staged anew.
    let mut cast = end.map(|_| request.cast()).transpose()?;
    let (mut staged, motion) = match &cast {
        Some(cast) => {
            let motion = during(Stage::Load, |_| request.motion(cast))?;
            (request.stage_with(cast.clone(), motion.as_ref())?, motion)
        }
        None => (request.stage()?, None),
    };
    if let (Some(cast), Some(slide)) = (&mut cast, &staged.model.slide) {
        cast.slide = Some(slide.image.clone());
    }
    let whole = if end.is_some() { 0.0 } else { 360.0 };
    let turn = Turn {
        axis: arguments.axis.map(|axis| <[f32; 3]>::from(axis).map(f64::from)),
        degrees: arguments.degrees.map_or(whole, |degrees| <[f64; 1]>::from(degrees)[0]),
        frames,
    };
    let mut cameras = if end.is_some() { vec![staged.camera] } else { cameras(request, &staged, &turn) };
    staged.options.projection = projection(&request.arguments, &cameras[0])?;
    let mut film = file.film((frames, fps), transparent);
    film.as_ref().map_or(Ok(()), |film| film.need([width, height]))?;
    // The model without its ground, for cameras below that.
    let mut bare = None;
    let triangles = staged.model.parts.iter().map(|part| part.triangles.len()).sum();
    if end.is_some() {
        let copies = EARLY as u64 * threads(&request.arguments).get() as u64;
        memory::need(copies * staged.model.bytes(), "the places of what moves")?;
    } else {
        let grounded = request.above_ground(&staged, &cameras);
        bare = grounded.contains(&false).then(|| (staged.model.clone(), grounded));
        request.add_ground_for(&mut staged, &mut cameras, Shadows::Made);
    }
    let Staged { model, options, samples, backdrop, .. } = staged;
    let set = Set { model: &model, options: &options, samples, backdrop: &backdrop };
    let (below, shadows) = (AtomicUsize::new(0), AtomicU64::new(0));
    // The shadow of things that stand while lights or the camera move.
    let standing = OnceLock::new();
    let things_move = motion.as_ref().is_some_and(|motion| motion.swept.moves());
    let moved = |frame: u32, cast: &Cast| {
        let request = request.at(matches, time(frame))?;
        let mut staged = request.stage_with(cast.clone(), motion.as_ref())?;
        staged.camera = turned(&request, &staged, &turn, frame);
        let projection = projection(&request.arguments, &staged.camera)?;
        ordered(&mut staged.model, &staged.camera, projection);
        if request.above_ground(&staged, &[staged.camera]) == [true] {
            let begin = Instant::now();
            let kept = standing.get().map_or(&[][..], Vec::as_slice);
            if let Some(ground) =
                request.add_ground(&mut staged, Shadows::Kept(kept)).filter(|_| !things_move)
            {
                // That of another thread is the same.
                _ = standing.set(ground.shadows);
            }
            let took = u64::try_from(begin.elapsed().as_nanos()).unwrap_or(u64::MAX);
            shadows.fetch_add(took, Ordering::Relaxed);
        } else {
            below.fetch_add(1, Ordering::Relaxed);
        }
        Ok(Shot { model: Cow::Owned(staged.model), camera: staged.camera, projection })
    };
    let shot = |at: usize| match (wanted.get(at), &cast) {
        (Some(&frame), Some(cast)) => moved(frame, cast),
        (Some(&frame), None) => {
            let below = bare.as_ref().filter(|(_, grounded)| !grounded[frame as usize]);
            let set = below.map_or(set, |(model, _)| Set { model, ..set });
            Ok(set.shot(cameras[frame as usize]))
        }
        (None, _) => Err(Error::new("a frame that is none", "one")),
    };
    let total = wanted.len() as u64;
    let drawn = during(Stage::Draw, |progress| {
        set.draw(wanted.len(), &shot, &mut |at, image| {
            progress.set(at as u64, total);
            stage::counted_as(Stage::Encode, || match &mut film {
                Some(film) => film.push(image),
                None => file.write_frame(wanted[at], &image, transparent),
            })
        })
    })?;
    let shadows = Duration::from_nanos(shadows.into_inner()).min(drawn.work);
    let encoding = stage::time(Stage::Encode);
    let works = [(Stage::Draw, drawn.work - shadows), (Stage::Shadow, shadows), (Stage::Encode, encoding)];
    stage::divide([Stage::Draw, Stage::Encode], works);
    during(Stage::Encode, |_| film.map_or(Ok(()), |film| file.write(film)))?;
    warn_of_frames_below(below.into_inner(), wanted.len());
    if drawn.empty > 0 {
        let found = format!("nothing of the model in {} of {} frames", drawn.empty, wanted.len());
        let hint = "see --eye, --target, --zoom, --near and --far";
        warn(&Error::new(found, "some of it").hint(hint).to_string());
    }
    if is_silent() {
        return Ok(());
    }
    let source = request.source().name();
    let times = stage::summary(&stage::times());
    let mut frames = counted(wanted.len(), "frame", "frames");
    if let Some(share) = share.filter(|share| share.is_part()) {
        frames += &format!(" of share {share}");
    }
    if !there.is_empty() {
        frames += &format!(" beside {} that were there", there.len());
    }
    print(&format!(
        "{source}: {}, {frames} of {width}x{height} pixels in {}{times}\n",
        counted(triangles, "triangle", "triangles"),
        output.display()
    ))
}

/// The cameras of all frames.
fn cameras(request: &Request, staged: &Staged, turn: &Turn) -> Vec<Camera> {
    let Staged { model, camera, options, .. } = staged;
    let wishes = request.arguments.camera.counted_from(model.origin);
    let ball = camera::bounding_sphere(model);
    turn.cameras((model, ball), camera, &wishes, (Sight::of(options), request.is_fitted()))
}

/// The camera of a frame in which things move.
fn turned(request: &Request, staged: &Staged, turn: &Turn, frame: u32) -> Camera {
    let Staged { model, swept, camera, options, .. } = staged;
    let wishes = request.arguments.camera.counted_from(model.origin);
    let whole = swept.as_ref().map_or(model, |swept| &swept.whole);
    let of = [model, whole].map(|model| (model, camera::bounding_sphere(model)));
    let share = f64::from(frame) / f64::from(turn.frames);
    turn.moved(of, camera, &wishes, (Sight::of(options), request.is_fitted()), share)
}

/// The options of `alberti assemble`.
#[derive(Clone, Debug, Args)]
pub struct AssembleArgs {
    /// Names of the pictures, such as frames/%04d.png: from the first, 0 to 1000, up to the last in a row.
    #[arg(value_name = "NAMES")]
    pub names: PathBuf,

    /// Film to write; the extension says the format: gif, png or apng, webp, y4m, mp4, mkv or webm.
    #[arg(short, long, value_name = "FILE", default_value = DEFAULT)]
    pub output: PathBuf,

    /// Frames a second, such as 24 or 29.97.
    #[arg(long, value_name = "N", default_value = "30", allow_hyphen_values = true)]
    pub fps: Rate,

    /// Print errors alone.
    #[arg(short, long)]
    pub quiet: bool,
}

pub(super) const ASSEMBLE_HELP: &str = "\
Examples:
  alberti assemble frames/%04d.png -o cow.gif
  alberti assemble frames/%04d.png -o cow.mp4 --fps 25";

/// Joins pictures to a film.
pub(super) fn assemble(matches: &ArgMatches) -> Result<(), Error> {
    let arguments = AssembleArgs::from_arg_matches(matches)
        .map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    stage::begin();
    forget();
    memory::begin(None);
    let (pictures, first) = pictures(&arguments.names)?;
    let count = u32::try_from(pictures.len()).unwrap_or(u32::MAX);
    let file = FilmFile::new(&arguments.output, |path| Whole::new(path, "-o"))?;
    file.too_fast(arguments.fps).iter().for_each(|warning| warn(&warning.to_string()));
    let alpha = pictures.iter().any(|picture| image_file::has_alpha(picture));
    let Some(mut film) = file.film((count, arguments.fps), alpha) else {
        let expected = format!("a film: {}", Format::extensions());
        return Err(Error::new("names of pictures", expected).file(&arguments.output));
    };
    let mut size = None;
    during(Stage::Encode, |progress| {
        for (path, done) in pictures.iter().zip(0..) {
            progress.set(done, u64::from(count));
            let image = during(Stage::Maps, |_| image_file::load_for_once(path))?;
            let [width, height] = *size.get_or_insert([image.width, image.height]);
            if [width, height] != [image.width, image.height] {
                let found = format!("{}x{} pixels", image.width, image.height);
                let error = Error::new(found, format!("{width}x{height} as in {}", pictures[0].display()));
                return Err(error.file(path));
            }
            if image.texels.iter().any(|texel| texel[3] < u8::MAX) {
                // Its alpha would be lost.
                file.check_alpha().map_err(|_| {
                    let error =
                        Error::new("a transparent picture", "opaque ones, or -o with gif, png or webp");
                    error.file(path)
                })?;
            }
            film.push(image)?;
        }
        file.write(film)
    })?;
    if is_silent() {
        return Ok(());
    }
    let [width, height] = size.unwrap_or_default();
    let mut frames = counted(pictures.len(), "frame", "frames");
    if first > 0 {
        frames += &format!(" from {first} on");
    }
    print(&format!(
        "{}: {frames} of {width}x{height} pixels in {}{}\n",
        arguments.names.display(),
        arguments.output.display(),
        stage::summary(&stage::times())
    ))
}
