//! Prices on the machine that is advised for.

use super::super::Advice;
use super::super::candidate::Candidate;
use super::super::machine::{Cost, Costs, Machine};
use super::super::work::{Work, work};
use super::look::draw;
use crate::error::Error;
use crate::options::RenderOptions;
use crate::scene::{Camera, Model};

/// Prices on the machine that is advised for.
pub(super) struct Bill {
    machine: Machine,
    costs: Costs,
    /// The advised policies, and the work under them.
    pick: Candidate,
    work: Work,
}

impl Bill {
    /// # Errors
    /// Options that the model of a chip does not know.
    pub(super) fn new(advice: &Advice, options: &RenderOptions) -> Result<Self, Error> {
        let machine = advice.wish.machine;
        let pick = &advice.trials[advice.pick];
        Ok(Self { machine, costs: Costs::new(machine, options)?, pick: pick.candidate, work: pick.work })
    }

    /// Bytes of a texel.
    pub(super) fn texel(&self) -> f64 {
        self.costs.texel()
    }

    /// The saving of so many milliseconds on the host, which a chip has no model of, and of so many bytes of maps or
    /// vertices. A picture of less that took longer did so by chance.
    pub(super) fn data(&self, time: f64, bytes: f64) -> Cost {
        if self.machine.is_chip() {
            Cost { flash: bytes, ..Cost::default() }
        } else {
            Cost { frame: time.max(0.0), ram: bytes, ..Cost::default() }
        }
    }

    /// The saving of leaving out the triangles that are not seen, of all parts in order.
    ///
    /// # Errors
    /// The scene cannot be drawn.
    pub(super) fn triangles(
        &self,
        model: &Model,
        camera: &Camera,
        options: &RenderOptions,
        seen: &[bool],
    ) -> Result<Cost, Error> {
        /// Three indices, of 16 bits on chips.
        const BYTES: [f64; 2] = [12.0, 6.0];
        let mut all = seen.iter();
        let mut without = model.clone();
        for part in &mut without.parts {
            part.triangles.retain(|_| all.next().copied().unwrap_or(true));
        }
        let unseen = u32::try_from(seen.iter().filter(|&&seen| !seen).count()).map_or(0.0, f64::from);
        if !self.machine.is_chip() {
            let [whole, left] = [model, &without].map(|model| draw(model, camera, options));
            return Ok(self.data(whole?.1 - left?.1, unseen * BYTES[0]));
        }
        let [whole, left] = [model, &without].map(|model| work(model, camera, &self.pick.options(options)));
        let price = |work| self.costs.of(self.pick, options, &work).map_or(0.0, |cost| cost.frame);
        let frame = price(whole?) - price(left?);
        Ok(Cost { frame, ..self.data(0.0, unseen * BYTES[1]) })
    }

    /// The saving of another filter or other places of levels of detail: by a clock on the host, by the model on chips.
    pub(super) fn reading(&self, time: f64, options: &RenderOptions, other: &RenderOptions) -> Cost {
        let at = |options| self.costs.of(self.pick, options, &self.work);
        match (at(options), at(other)) {
            (Some(whole), Some(other)) => Cost {
                frame: whole.frame - other.frame,
                flash: whole.flash - other.flash,
                ram: whole.ram - other.ram,
            },
            _ => Cost { frame: time, ..Cost::default() },
        }
    }

    /// A saving in words, and what it costs in time.
    pub(super) fn saves(&self, saved: Cost) -> String {
        let bytes = |bytes: f64, of: &str| {
            let text = if bytes < 10240.0 {
                format!("{bytes:.0} bytes")
            } else {
                format!("{:.0} KB", bytes / 1024.0)
            };
            (bytes >= 0.5).then(|| format!("{text} of {of}"))
        };
        let frame = |frame: f64| {
            if self.machine.is_chip() {
                (frame >= 500.0).then(|| format!("{:.3} M instructions a frame", frame / 1e6))
            } else {
                (frame >= 0.005).then(|| format!("{frame:.2} ms a frame"))
            }
        };
        let memory = if self.machine.is_chip() { "RAM" } else { "memory" };
        let parts: Vec<String> = [frame(saved.frame), bytes(saved.flash, "flash"), bytes(saved.ram, memory)]
            .into_iter()
            .flatten()
            .collect();
        let saves = match parts.split_last() {
            None => "saves nothing".to_owned(),
            Some((last, [])) => format!("saves {last}"),
            Some((last, first)) => format!("saves {} and {last}", first.join(", ")),
        };
        match frame(-saved.frame) {
            None => saves,
            Some(dearer) => format!("{saves}, and costs {dearer}"),
        }
    }
}
