//! The cost of a picture: counts from the pipeline and times from the clock, as text or as JSON.

use super::stage;
use crate::camera::as_options;
use crate::error::{counted, decimal};
use crate::options::{CameraTable, Projection, Samples};
use crate::scene::Camera;
use alberti::Stats;
use serde::ser::{Serialize, SerializeMap as _, Serializer};
use serde_json::json;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

/// A report of one run.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The picture's file.
    pub output: &'a Path,
    /// The model's file, or else the built-in scene's name.
    pub source: Source<'a>,
    /// The picture's size.
    pub size: (u32, u32),
    /// Samples a pixel.
    pub samples: Samples,
    /// Triangles of the model: without those of a ground, which counts have.
    pub triangles: usize,
    /// Counts.
    pub stats: Stats,
    /// The wall-clock time of each stage of the work, in their order.
    pub times: [(&'static str, Duration); 8],
    /// The camera that was used.
    pub camera: Camera,
    /// The point from which its coordinates are counted.
    pub origin: [f64; 3],
    /// Its projection.
    pub projection: Projection,
    /// That of the options, which the camera's have to go over.
    pub wishes: CameraTable,
}

/// The origin of the triangles.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// A file.
    Model(&'a Path),
    /// A built-in scene.
    Scene(&'a str),
}

impl Source<'_> {
    /// Its name in a summary.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Model(path) if path == Path::new("-") => "standard input".to_owned(),
            Self::Model(path) => path.display().to_string(),
            Self::Scene(name) => format!("built-in scene {name}"),
        }
    }
}

impl Report<'_> {
    /// A line of what was made from what, with the times that are not 0, and one of the camera's options.
    pub fn summary(&self) -> String {
        let source = self.source.name();
        let (width, height) = self.size;
        let times = stage::summary(&self.times);
        format!(
            "{source}: {}, {width}x{height} pixels in {}{times}\ncamera: {}",
            counted(self.triangles, "triangle", "triangles"),
            self.output.display(),
            as_options(&self.camera, self.origin, self.projection, &self.wishes, true)
        )
    }

    /// A line each.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (name, count) in self.counts() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{name:<14}{count:>12}");
        }
        for (name, time) in self.times {
            let _ = writeln!(text, "{name:<14}{:>12.3} ms", ms(time));
        }
        text
    }

    /// One JSON object on one line: `output`, `model` or `scene`, `width`, `height`, `samples`, the counts (see
    /// [`Stats`]), `camera` and `ms`. The camera has its numbers and, as `options`, the words that make it
    /// again; `ms` has `load`, `maps`, `mip_maps`, `numbers`, `shadow`, `draw`, `count` and `encode`.
    pub fn json(&self) -> String {
        // Strings and finite numbers cannot be refused.
        serde_json::to_string(self).unwrap_or_default()
    }

    fn counts(&self) -> [(&'static str, u64); 8] {
        let s = self.stats;
        [
            ("triangles_in", s.submitted),
            ("outside", s.dropped),
            ("clipped", s.clipped),
            ("culled", s.culled),
            ("missed", s.missed),
            ("drawn", s.drawn),
            ("fragments", s.fragments),
            ("written", s.written),
        ]
    }
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

impl Serialize for Report<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_map(None)?;
        fields.serialize_entry("output", &self.output.display().to_string())?;
        match self.source {
            Source::Model(path) => fields.serialize_entry("model", &path.display().to_string())?,
            Source::Scene(name) => fields.serialize_entry("scene", name)?,
        }
        fields.serialize_entry("width", &self.size.0)?;
        fields.serialize_entry("height", &self.size.1)?;
        fields.serialize_entry("samples", &self.samples.side().pow(2))?;
        for (name, count) in self.counts() {
            fields.serialize_entry(name, &count)?;
        }
        let Camera { eye, target, up, roll, fov, near, far } = self.camera;
        let options = as_options(&self.camera, self.origin, self.projection, &self.wishes, true);
        let numbers = json!({
            "eye": eye.map(decimal), "target": target.map(decimal), "up": up.map(decimal), "roll": roll,
            "fov": decimal(fov), "near": decimal(near), "far": decimal(far),
            "options": options,
        });
        fields.serialize_entry("camera", &numbers)?;
        let thousandths = |time| (ms(time) * 1e3).round() / 1e3;
        let times = self.times.map(|(name, time)| (name, thousandths(time)));
        fields.serialize_entry("ms", &InOrder(&times))?;
        fields.end()
    }
}

/// Numbers by name, in their order.
struct InOrder<'a>(&'a [(&'static str, f64)]);

impl Serialize for InOrder<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report<'a>(output: &'a Path, source: Source<'a>) -> Report<'a> {
        let stats = Stats { submitted: 5, clipped: 4, culled: 3, drawn: 2, fragments: 1, ..Stats::default() };
        let names = ["load", "maps", "mip_maps", "numbers", "shadow", "draw", "count", "encode"];
        let mut times = names.map(|name| (name, Duration::ZERO));
        times[0].1 = Duration::from_micros(1500);
        times[2].1 = Duration::from_micros(700);
        let camera = Camera {
            eye: [0.0, 1.5, 1e-7],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 40.0,
            near: 0.1,
            far: 10.0,
        };
        let projection = Projection::Parallel { height: 2.5 };
        let (samples, triangles) = (Samples::Four, 5);
        Report {
            output,
            source,
            size: (7, 6),
            samples,
            triangles,
            stats,
            times,
            camera,
            origin: [0.0; 3],
            projection,
            wishes: CameraTable::default(),
        }
    }

    #[test]
    fn json_is_json() {
        let output = Path::new("a\"\\\n\u{7f}é.png");
        let text = report(output, Source::Scene("hero")).json();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["output"], "a\"\\\n\u{7f}é.png");
        assert_eq!(value["scene"], "hero");
        assert_eq!(value["width"], 7);
        assert_eq!(value["triangles_in"], 5);
        assert_eq!(value["fragments"], 1);
        assert_eq!(value["ms"]["load"], 1.5);
        assert!(!text.contains('\n'));
        let names = [
            "output",
            "scene",
            "width",
            "triangles_in",
            "written",
            "ms",
            "load",
            "maps",
            "mip_maps",
            "numbers",
            "shadow",
            "draw",
            "count",
            "encode",
        ];
        assert!(names.map(|name| text.find(&format!("\"{name}\":"))).is_sorted(), "{text}");
    }

    #[test]
    fn text_names_everything() {
        let report = report(Path::new("a.png"), Source::Model(Path::new("m.obj")));
        assert_eq!(report.text().lines().count(), 16);
        let summary = "m.obj: 5 triangles, 7x6 pixels in a.png; load 1.5 ms, mip maps 0.7 ms\n\
                       camera: --eye 0,1.5,1e-7 --target 0,0,0 --up 0,1,0 --fov 40 --near 0.1 --far 10 \
                       --projection parallel --view-height 2.5";
        assert_eq!(report.summary(), summary);
    }
}
