//! Things that move in a scene file: values of keys that go from one to the next in time. A frame is the picture of a
//! file in which these keys have their values of that time.

use clap::ValueEnum;
use toml::{Table, Value};

use super::source::Source;
use super::tables::{Animation, File};
use crate::cli::words::nearest;
use crate::error::{Error, counted, number, quote};
use crate::options::values::{Color, one_of, words};
use crate::scene::normals::narrow;

/// The way from one value to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Easing {
    /// As fast all the time.
    #[default]
    Linear,
    /// From rest.
    EaseIn,
    /// To rest.
    EaseOut,
    /// From rest to rest.
    EaseInOut,
    /// None: the value stays up to the next.
    Hold,
    /// On a smooth curve through all values.
    Spline,
}

impl Easing {
    /// The share of the way after a share of the time.
    fn ease(self, share: f64) -> f64 {
        match self {
            Self::Linear | Self::Spline => share,
            Self::EaseIn => share * share,
            Self::EaseOut => share * (2.0 - share),
            Self::EaseInOut => share * share * (3.0 - 2.0 * share),
            Self::Hold => 0.0,
        }
    }
}

words!(one_of: Easing);

/// The keys that may move, of each kind of table.
const MOVING: [(&str, &[&str]); 5] = [
    (
        "camera",
        &["eye", "target", "up", "azimuth", "elevation", "roll", "zoom", "fov", "near", "far", "view-height"],
    ),
    ("projector", &["eye", "target", "fov"]),
    ("ambient", &["color", "intensity"]),
    ("object", &["position", "rotation", "scale"]),
    ("light", &["position", "target", "direction", "color", "intensity", "angle", "range"]),
];

/// A key, and its values in time.
#[derive(Clone, Debug)]
pub(super) struct Track {
    table: &'static str,
    /// Which of several tables it is.
    index: Option<usize>,
    key: String,
    /// In rising order.
    times: Vec<f64>,
    values: Vec<Value>,
    easing: Easing,
    repeats: bool,
}

impl Track {
    /// The path of its key.
    pub(super) fn path(&self) -> String {
        match self.index {
            Some(index) => format!("{}[{index}].{}", self.table, self.key),
            None => format!("{}.{}", self.table, self.key),
        }
    }

    /// Whether it is the same at two times: equal values, or angles that are whole turns apart.
    pub(super) fn is_same(&self, a: f64, b: f64) -> bool {
        let (a, b) = (self.at(a), self.at(b));
        let turns = ["rotation", "azimuth", "roll"].contains(&self.key.as_str());
        match (Numbers::of(&a), Numbers::of(&b)) {
            (Some(from), Some(to)) if turns => {
                let apart = |(from, to): (&f64, &f64)| (to - from).rem_euclid(360.0).abs();
                from.numbers.iter().zip(&to.numbers).all(|pair| apart(pair) <= 0.0)
            }
            _ => a == b,
        }
    }

    /// The times of its values.
    pub(super) fn times(&self) -> impl Iterator<Item = f64> {
        self.times.iter().copied()
    }

    /// The time of its last value.
    pub(super) fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or_default()
    }

    /// Writes the value of a time into a file.
    pub(super) fn write(&self, time: f64, file: &mut Table) {
        self.put(self.at(time), file);
    }

    fn put(&self, value: Value, file: &mut Table) {
        let table = match (self.index, file.get_mut(self.table)) {
            (Some(index), Some(Value::Array(tables))) => tables.get_mut(index),
            (None, Some(table)) => Some(table),
            (None, None) => Some(file.entry(self.table).or_insert(Value::Table(Table::new()))),
            _ => None,
        };
        if let Some(Value::Table(table)) = table {
            table.insert(self.key.clone(), value);
        }
    }

    /// The value of a time: of one before the first or after the last, theirs.
    fn at(&self, time: f64) -> Value {
        let (first, end) = (self.times.first().copied().unwrap_or_default(), self.end());
        let time =
            if self.repeats && end > first { first + (time - first).rem_euclid(end - first) } else { time };
        let next = self.times.partition_point(|&at| at <= time);
        let Some(before) = next.checked_sub(1) else { return self.value(0) };
        if next >= self.times.len() || self.easing == Easing::Hold {
            return self.value(before);
        }
        let share = (time - self.times[before]) / (self.times[next] - self.times[before]);
        if share <= 0.0 {
            return self.value(before);
        }
        match (Numbers::of(&self.values[before]), Numbers::of(&self.values[next])) {
            (Some(from), Some(to)) => {
                let eased = self.easing.ease(share);
                let numbers = from.numbers.iter().zip(&to.numbers).enumerate().map(|(k, (a, b))| {
                    if self.easing == Easing::Spline {
                        self.curve(before, k, share)
                    } else {
                        a + (b - a) * eased
                    }
                });
                Numbers { numbers: numbers.collect(), ..from }.value()
            }
            _ => self.value(before),
        }
    }

    fn value(&self, index: usize) -> Value {
        self.values.get(index).cloned().unwrap_or(Value::Boolean(false))
    }

    /// A number on a cubic curve through all values of that component, by Catmull and Rom: at each value as steep as
    /// the line between its neighbours.
    fn curve(&self, before: usize, component: usize, share: f64) -> f64 {
        let number = |index: usize| {
            let numbers = self.values.get(index).and_then(Numbers::of);
            numbers.and_then(|all| all.numbers.get(component).copied()).unwrap_or_default()
        };
        let last = self.times.len() - 1;
        let slope = |index: usize| {
            let (low, high) = (index.saturating_sub(1), (index + 1).min(last));
            (number(high) - number(low)) / (self.times[high] - self.times[low])
        };
        let length = self.times[before + 1] - self.times[before];
        let [from, to] = [number(before), number(before + 1)];
        let [start, end] = [slope(before) * length, slope(before + 1) * length];
        // Hermite's form.
        let (s, rest) = (share, 1.0 - share);
        from * (1.0 + 2.0 * s) * rest * rest + start * s * rest * rest + to * s * s * (3.0 - 2.0 * s)
            - end * s * s * rest
    }
}

/// A value as numbers, and the form in which it is written.
struct Numbers {
    numbers: Vec<f64>,
    form: Form,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Number,
    Array,
    Color,
}

impl Numbers {
    fn of(value: &Value) -> Option<Self> {
        #[expect(clippy::cast_precision_loss, reason = "it becomes an f64 anyway")]
        let number = |value: &Value| match value {
            Value::Integer(number) => Some(*number as f64),
            Value::Float(number) => Some(*number),
            _ => None,
        };
        let (numbers, form) = match value {
            Value::Array(values) => (values.iter().map(number).collect::<Option<_>>()?, Form::Array),
            Value::String(text) => {
                let Color(color) = text.parse().ok()?;
                (color.map(f64::from).to_vec(), Form::Color)
            }
            value => (vec![number(value)?], Form::Number),
        };
        Some(Self { numbers, form })
    }

    fn value(self) -> Value {
        match self.form {
            Form::Number => Value::Float(self.numbers.first().copied().unwrap_or_default()),
            Form::Array => Value::Array(self.numbers.into_iter().map(Value::Float).collect()),
            Form::Color => {
                let byte =
                    |k: usize| narrow(self.numbers.get(k).copied().unwrap_or_default().clamp(0.0, 1.0));
                let [r, g, b] = Color([byte(0), byte(1), byte(2)]).bytes();
                Value::String(format!("{r:02x}{g:02x}{b:02x}"))
            }
        }
    }
}

/// All that moves in a file.
///
/// # Errors
/// An animation that lacks something, or whose values cannot be.
pub(super) fn tracks(source: &Source, file: &File) -> Result<Vec<Track>, Error> {
    let names = names(source, file)?;
    let mut tracks: Vec<Track> = Vec::new();
    for (index, animation) in file.animation.iter().enumerate() {
        let path = format!("animation[{index}]");
        let track = track(source, animation, &path, &names)?;
        if tracks.iter().any(|other| other.path() == track.path()) {
            let found = format!("a second animation of {}", track.path());
            return Err(source.error(&format!("{path}.key"), found, "one, with all values"));
        }
        for (value, k) in track.values.iter().zip(0..) {
            let with = |file: &mut Table| track.put(value.clone(), file);
            source
                .changed(with)
                .map_err(|error| source.refused_at(&error, &format!("{path}.values[{k}]")))?;
        }
        tracks.push(track);
    }
    Ok(tracks)
}

/// The tables with names of their own: each with its kind and which it is.
type Names<'a> = Vec<(&'a str, &'static str, Option<usize>)>;

fn names<'a>(source: &Source, file: &'a File) -> Result<Names<'a>, Error> {
    let mut names: Names<'a> =
        ["camera", "projector", "ambient"].into_iter().map(|table| (table, table, None)).collect();
    let objects = file.object.iter().map(|object| ("object", &object.name)).zip(0..);
    let lights = file.light.iter().map(|light| ("light", &light.name)).zip(0..);
    for ((table, name), index) in objects.chain(lights) {
        let Some(name) = name else { continue };
        if names.iter().any(|(other, ..)| other == name) {
            let found = format!("the name {} for the second time", quote(name.as_bytes()));
            let path = format!("{table}[{index}].name");
            return Err(source.error(
                &path,
                found,
                "a name for each, other than camera, projector and ambient",
            ));
        }
        names.push((name, table, Some(index)));
    }
    Ok(names)
}

fn track(source: &Source, animation: &Animation, path: &str, names: &Names<'_>) -> Result<Track, Error> {
    let Animation { of, key, times, values, easing, repeat } = animation;
    let missing =
        |found: &str, expected: &str| source.error(path, format!("an animation without {found}"), expected);
    let wrong =
        |key: &str, found: String, expected: String| source.error(&format!("{path}.{key}"), found, expected);
    let of = of.as_ref().ok_or_else(|| {
        missing("of", "of = \"camera\", \"projector\", \"ambient\", or the name of an object or a light")
    })?;
    let Some(&(_, table, index)) = names.iter().find(|(name, ..)| name == of) else {
        let known: Vec<_> = names.iter().map(|(name, ..)| *name).collect();
        let error = wrong(
            "of",
            format!("the unknown name {}", quote(of.as_bytes())),
            format!("one of {}", known.join(", ")),
        );
        return Err(error.hint("an [[object]] and a [[light]] have names by name = \"...\""));
    };
    let keys = MOVING.iter().find(|(kind, _)| *kind == table).map_or(&[][..], |(_, keys)| keys);
    let expected = || format!("one of {}", keys.join(", "));
    let key = key.as_ref().ok_or_else(|| missing("key", &format!("key, {}", expected())))?;
    if !keys.contains(&key.as_str()) {
        let found = format!("{}, which does not move", quote(key.as_bytes()));
        let error = wrong("key", found, expected());
        return Err(match nearest(key, keys.iter().copied()) {
            Some(near) => error.hint(format!("did you mean {near}?")),
            None => error,
        });
    }
    let times =
        times.as_ref().ok_or_else(|| missing("times", "times in seconds, such as times = [0, 2.5]"))?;
    let times: Vec<f64> = times.iter().map(|&time| <[f64; 1]>::from(time)[0]).collect();
    let values = values.as_ref().ok_or_else(|| missing("values", "values, one for each of the times"))?;
    if times.is_empty() {
        return Err(wrong("times", "no times".to_owned(), "one or more".to_owned()));
    }
    let early = |k: usize| if k == 0 { times[0] < 0.0 } else { times[k] <= times[k - 1] };
    if let Some(k) = (0..times.len()).find(|&k| early(k)) {
        let found = format!("{} s", number(narrow(times[k])));
        let expected = if k == 0 { "0 or later" } else { "a time after the one before" };
        return Err(wrong(&format!("times[{k}]"), found, expected.to_owned()));
    }
    if values.len() != times.len() {
        let found = format!("{} for {} times", counted(values.len(), "value", "values"), times.len());
        return Err(wrong("values", found, "one for each of the times".to_owned()));
    }
    let mut form = None;
    for (value, k) in values.iter().zip(0..) {
        let numbers = Numbers::of(value);
        let of = numbers.map(|numbers| (numbers.numbers.len(), numbers.form));
        let wanted = *form.get_or_insert(of);
        if of.is_none() || of != wanted {
            let expected = match of {
                None if key == "color" => "a colour: rrggbb, rgb or a name",
                None => "a number, numbers in brackets, or a colour in quotes",
                Some(_) => "a value like the first",
            };
            let key = format!("values[{k}]");
            return Err(wrong(&key, source.shown(&format!("{path}.{key}")), expected.to_owned()));
        }
    }
    Ok(Track {
        table,
        index,
        key: key.clone(),
        times,
        values: values.clone(),
        easing: easing.unwrap_or_default(),
        repeats: repeat.unwrap_or_default(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(easing: Easing, repeats: bool, values: &[[f64; 2]]) -> Track {
        let values = values.iter().map(|pair| Value::Array(pair.map(Value::Float).to_vec())).collect();
        Track {
            table: "light",
            index: Some(0),
            key: "angle".into(),
            times: vec![1.0, 3.0, 4.0],
            values,
            easing,
            repeats,
        }
    }

    fn at(track: &Track, time: f64) -> [f64; 2] {
        Numbers::of(&track.at(time)).expect("numbers").numbers.try_into().expect("two")
    }

    #[test]
    fn values_are_those_of_their_times_and_between_them_of_the_easing() {
        let values = [[0.0, 10.0], [8.0, 2.0], [1.0, 2.0]];
        for (easing, quarter) in [
            (Easing::Linear, 0.25),
            (Easing::EaseIn, 0.0625),
            (Easing::EaseOut, 0.4375),
            (Easing::EaseInOut, 0.15625),
            (Easing::Hold, 0.0),
        ] {
            let track = track(easing, false, &values);
            for (time, expected) in [(-1.0, 0), (1.0, 0), (3.0, 1), (4.0, 2), (9.0, 2)] {
                assert_eq!(at(&track, time), values[expected], "{easing:?} {time}");
            }
            assert_eq!(at(&track, 1.5), [8.0 * quarter, 10.0 - 8.0 * quarter], "{easing:?}");
        }
        let repeated = track(Easing::Linear, true, &values);
        assert_eq!(at(&repeated, 5.0), at(&repeated, 2.0));
        assert_eq!(at(&repeated, 4.0), values[0]);
    }

    /// A parabola's slopes are those of its chords where times are as far apart: the curve is the parabola.
    #[test]
    fn a_curve_goes_on_in_its_direction() {
        let values = [[0.0, 0.0], [1.0, 1.0], [4.0, 2.0], [9.0, 3.0]];
        let mut track = track(Easing::Spline, false, &values);
        track.times = vec![0.0, 1.0, 2.0, 3.0];
        for share in [0.0, 0.25, 0.5, 0.9] {
            let [square, line] = at(&track, 1.0 + share);
            let time = 1.0 + share;
            assert!((square - time * time).abs() < 1e-12 && (line - time).abs() < 1e-12, "{square} {line}");
        }
        // It has no corners.
        let slope = |time: f64| (at(&track, time + 1e-6)[0] - at(&track, time)[0]) / 1e-6;
        assert!((slope(2.0 - 1e-6) - slope(2.0)).abs() < 1e-4);
    }

    #[test]
    fn colours_go_through_those_between() {
        let mut track = track(Easing::Linear, false, &[[0.0; 2]; 3]);
        track.values = ["black", "ff8040", "000000"].map(|text| Value::String(text.into())).to_vec();
        assert_eq!(track.at(2.0), Value::String("804020".into()));
        assert_eq!(track.at(3.0), Value::String("ff8040".into()));
    }
}
