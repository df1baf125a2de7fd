//! All numbers as one file in the Bencher Metric Format: of each benchmark its measures, of each the value and, where
//! there is one, its interval.

use serde_json::{Map, Value, json};

use super::{chips, counts, frames, ratios, results};

/// The file.
pub(super) fn json() -> Result<String, String> {
    let mut all = Map::new();
    for frame in frames::read(&results::read(frames::PLACE)?)? {
        let [low, high] = frame.interval;
        let latency =
            json!({ "latency": { "value": frame.median, "lower_value": low, "upper_value": high } });
        all.insert(format!("frames/{}/{}/{}", frame.scene, frame.size, frame.renderer), latency);
    }
    let times = ratios::read(&results::read(ratios::PLACE)?)?;
    for time in &times {
        let Some((_, ratio)) = ratios::of(&times, &time.size, &time.scene, &time.renderer) else { continue };
        let name = format!("peers/{}/{}/{}", time.scene, time.size, time.renderer);
        let latency = json!({ "value": 1e6 * time.milliseconds });
        all.insert(name, json!({ "latency": latency, "ratio": { "value": ratio } }));
    }
    let instructions = |figure: u64| json!({ "instructions": { "value": figure } });
    for count in counts::read(&results::read(counts::PLACE)?)? {
        all.insert(format!("counts/{}", count.name), instructions(count.instructions));
    }
    for chips::Count { board, scene, instructions: figure } in chips::read(&results::read(chips::PLACE)?)? {
        all.insert(format!("boards/{board}/{scene}"), instructions(figure));
    }
    Ok(format!("{:#}\n", Value::Object(all)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names and values that the format's own description has: a number for each measure.
    #[test]
    fn each_measure_has_a_number() {
        let all: Value = serde_json::from_str(&json().unwrap()).unwrap();
        let all = all.as_object().unwrap();
        for part in [
            "frames/mesh/320x240/Exact",
            "peers/mesh/320x240/euc",
            "counts/frame/mesh/Exact",
            "boards/m4f/mesh",
        ] {
            assert!(all.contains_key(part), "{part}");
        }
        for (name, measures) in all {
            let measures = measures.as_object().unwrap();
            assert!(!measures.is_empty(), "{name}");
            for (measure, metric) in measures {
                let value = metric["value"].as_f64().unwrap();
                assert!(value > 0.0, "{name} {measure}");
                if let (Some(low), Some(high)) =
                    (metric["lower_value"].as_f64(), metric["upper_value"].as_f64())
                {
                    assert!(low <= value && value <= high, "{name} {measure}");
                }
            }
        }
        let ratio = all["peers/mesh/320x240/Exact"]["ratio"]["value"].as_f64();
        assert_eq!(ratio, Some(1.0));
    }
}
