//! The texels that a filter reads, one by one, with their weights.

use super::super::maps::{any_wrap, mip_filter};
use super::look::number;
use crate::options::{Filter, Wrap};
use alberti::Rgba8;
use alberti::lanes::Lanes;
use alberti::raster::Gradient;
use alberti::texture::format::Rgba8888;
use alberti::texture::{AnyMipFilter, AnyWrap, Mipmap, Texture};

/// A map as it was read for a fragment.
#[derive(Clone, Debug)]
pub(crate) struct MapRead {
    /// Its key in a scene file.
    pub(crate) name: &'static str,
    pub(crate) size: [u32; 2],
    pub(crate) filter: Filter,
    pub(crate) wrap: Wrap,
    /// The level of detail at which levels are read, of a mip map.
    pub(crate) lambda: Option<f64>,
    /// The places at which it was read.
    pub(crate) probes: Vec<ProbeRead>,
    /// The filter's answer.
    pub(crate) value: Rgba8,
}

/// A place at which a map was read.
#[derive(Clone, Debug)]
pub(crate) struct ProbeRead {
    pub(crate) uv: [f64; 2],
    pub(crate) levels: Vec<LevelRead>,
}

/// A level of a map that was read.
#[derive(Clone, Debug)]
pub(crate) struct LevelRead {
    pub(crate) level: u32,
    /// In 256ths.
    pub(crate) weight: u32,
    pub(crate) size: [u32; 2],
    pub(crate) texels: Vec<TexelRead>,
}

/// A texel that was read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TexelRead {
    pub(crate) column: u32,
    /// From the top.
    pub(crate) row: u32,
    /// In 65536ths.
    pub(crate) weight: u32,
    pub(crate) color: Rgba8,
}

/// The way of reading a map.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) name: &'static str,
    pub(super) filter: Filter,
    pub(super) wrap: Wrap,
}

/// The levels of a map.
#[derive(Clone, Copy, Debug)]
pub(super) enum Levels<'a> {
    /// One.
    Flat(Texture<'a, Rgba8888>),
    /// All.
    Mipmap(Mipmap<'a, Rgba8888>),
}

impl<'a> Levels<'a> {
    fn count(&self) -> u32 {
        match self {
            Self::Flat(_) => 1,
            Self::Mipmap(mipmap) => u32::try_from(mipmap.levels()).unwrap_or(1),
        }
    }

    fn level(&self, level: u32) -> Texture<'a, Rgba8888> {
        match self {
            Self::Flat(texture) => *texture,
            Self::Mipmap(mipmap) => mipmap.level(level as usize),
        }
    }
}

/// A map's texels at `uv`, where it gave `value`.
pub(super) fn read<L: Lanes>(
    lanes: L,
    way: Way,
    levels: Levels<'_>,
    (uv, gradient): ([L::Number; 2], Gradient<[L::Number; 2]>),
    value: Rgba8,
) -> MapRead {
    let base = levels.level(0);
    let size = [base.width(), base.height()];
    let filter = mip_filter(way.filter);
    let probes = filter.probes(lanes, gradient, size, |lambda| lambda);
    let mipmapped = !matches!(filter, AnyMipFilter::Base(_));
    let log2_count = word(lanes, probes.log2_count);
    let at = |probe| {
        let uv = probes.place(lanes, log2_count, probe, uv);
        let levels = levels_at(lanes, (filter, any_wrap(way.wrap)), levels, uv, probes.lambda);
        ProbeRead { uv: uv.map(|x| number(lanes, x)), levels }
    };
    MapRead {
        name: way.name,
        size,
        filter: way.filter,
        wrap: way.wrap,
        lambda: mipmapped.then(|| number(lanes, probes.lambda)),
        probes: (0..1 << log2_count).map(at).collect(),
        value,
    }
}

/// The levels that are read at a place: one in magnification, else the two about λ.
fn levels_at<L: Lanes>(
    lanes: L,
    (filter, wrap): (AnyMipFilter, AnyWrap),
    levels: Levels<'_>,
    uv: [L::Number; 2],
    lambda: L::Number,
) -> Vec<LevelRead> {
    let nearest = filter == AnyMipFilter::Base(alberti::texture::AnyFilter::Nearest);
    let level = |level: u32, weight: u32| {
        let texture = levels.level(level);
        let texels = if nearest { cell(lanes, texture, wrap, uv) } else { around(lanes, texture, wrap, uv) };
        LevelRead { level, weight, size: [texture.width(), texture.height()], texels }
    };
    let zero = lanes.splat(0.0);
    if lanes.bits(lanes.less(zero, lambda)) & 1 == 0 {
        return vec![level(0, 256)];
    }
    let last = lanes.int_to_number(lanes.int((levels.count() - 1).cast_signed()));
    let position = word(lanes, lanes.round_scaled(lanes.min(lanes.max(lambda, zero), last), 8));
    let (near, far) = (position >> 8, position & 255);
    let mut read = vec![level(near, 256 - far)];
    if far > 0 {
        read.push(level(near + 1, far));
    }
    read
}

/// The texel whose cell holds a place.
fn cell<L: Lanes>(
    lanes: L,
    texture: Texture<'_, Rgba8888>,
    wrap: AnyWrap,
    uv: [L::Number; 2],
) -> Vec<TexelRead> {
    let [column, row] = texture.cells(lanes, uv, (wrap, wrap)).map(|words| word(lanes, words));
    vec![texel(texture, [column, row], 1 << 16)]
}

/// The texels around a place that have a weight.
fn around<L: Lanes>(
    lanes: L,
    texture: Texture<'_, Rgba8888>,
    wrap: AnyWrap,
    uv: [L::Number; 2],
) -> Vec<TexelRead> {
    let [[left, right, along], [low, high, up]] =
        texture.between(lanes, uv, (wrap, wrap)).map(|axis| axis.map(|words| word(lanes, words)));
    let columns = [(left, 256 - along), (right, along)];
    let rows = [(low, 256 - up), (high, up)];
    let all = rows.into_iter().flat_map(|row| columns.map(|column| (column, row)));
    let some = all.filter(|((_, a), (_, b))| a * b > 0);
    some.map(|((column, a), (row, b))| texel(texture, [column, row], a * b)).collect()
}

fn texel(texture: Texture<'_, Rgba8888>, [column, from_bottom]: [u32; 2], weight: u32) -> TexelRead {
    let row = (texture.height() - 1).saturating_sub(from_bottom);
    TexelRead { column, row, weight, color: texture.texel(column, row) }
}

/// The first of words.
pub(super) fn word<L: Lanes>(lanes: L, words: L::U32) -> u32 {
    lanes.store_words(words).as_ref().first().copied().unwrap_or_default()
}
