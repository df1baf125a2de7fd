//! The file that [`Baked`](alberti::baked::Baked) reads in place; its module has the layout.

use super::Asset;
use super::packed::Packed;
use super::shape::Piece;
use super::texels::Texture;
use alberti::Meshlet;
use alberti::baked::{Attributes, HEADER, MAGIC, VERSION};

/// The number of no texture.
const NONE: u16 = u16::MAX;
/// The bytes of an entry of a texture.
const ENTRY: usize = 16;

/// The bytes of an asset. Of arrays of vertices there are those that it has attributes of.
#[must_use]
pub fn bytes(asset: &Asset) -> Vec<u8> {
    let mut file = vec![0; HEADER];
    let vertices = || asset.pieces.iter().flat_map(|piece| &piece.vertices);
    file.extend(vertices().flat_map(|v| v.place).flat_map(i16::to_le_bytes));
    let has = |attribute| asset.attributes.contains(attribute);
    if has(Attributes::UV) {
        file.extend(vertices().flat_map(|v| v.uv).flat_map(u16::to_le_bytes));
    }
    if has(Attributes::NORMAL) {
        file.extend(vertices().flat_map(|v| v.normal.map(i8::cast_unsigned)));
    }
    if has(Attributes::TANGENT) {
        file.extend(vertices().flat_map(|v: &Packed| v.tangent.map(i8::cast_unsigned)));
    }
    if has(Attributes::COLOR) {
        file.extend(vertices().flat_map(|v| v.color));
    }
    let indices = asset.pieces.iter().flat_map(|piece| piece.triangles.as_flattened());
    file.extend(indices.flat_map(|index| index.to_le_bytes()));
    file.extend(asset.pieces.iter().flat_map(|piece| &piece.meshlets).flat_map(meshlet));
    let mut starts = [0; 3];
    for piece in &asset.pieces {
        file.extend(part(piece, &mut starts));
    }
    let mut place = file.len() + asset.textures.len() * ENTRY;
    for texture in &asset.textures {
        file.extend(entry(texture, place));
        place += length(texture);
    }
    for texture in &asset.textures {
        file.extend(texture.palette.as_flattened());
        file.extend(texture.levels.iter().flatten());
    }
    let header = header(asset, starts, file.len());
    file[..header.len()].copy_from_slice(&header);
    file
}

fn header(asset: &Asset, [vertices, triangles, meshlets]: [u32; 3], length: usize) -> Vec<u8> {
    let mut header = MAGIC.to_vec();
    header.extend(VERSION.to_le_bytes());
    header.extend(asset.attributes.bits().to_le_bytes());
    header.extend([count(length), vertices, triangles, meshlets].map(u32::to_le_bytes).as_flattened());
    let few = [asset.pieces.len(), asset.textures.len()].map(|n| u16::try_from(n).unwrap_or(u16::MAX));
    header.extend(few.map(u16::to_le_bytes).as_flattened());
    header.extend(asset.unit.to_le_bytes());
    header
}

fn meshlet(meshlet: &Meshlet) -> Vec<u8> {
    let signed = |all: &[i16]| all.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<u8>>();
    [
        meshlet.triangles.map(u32::to_le_bytes).as_flattened(),
        &signed(&meshlet.center),
        &meshlet.radius.to_le_bytes(),
        &signed(&meshlet.axis),
        &meshlet.squared_sine.to_le_bytes(),
        &signed(&meshlet.depths),
    ]
    .concat()
}

/// A part, whose vertices, triangles and meshlets start there.
fn part(piece: &Piece, starts: &mut [u32; 3]) -> Vec<u8> {
    let mut bytes = vec![];
    let lengths = [piece.vertices.len(), piece.triangles.len(), piece.meshlets.len()];
    for (start, length) in starts.iter_mut().zip(lengths.map(count)) {
        bytes.extend([*start, length].map(u32::to_le_bytes).as_flattened());
        *start += length;
    }
    let [x, y, z] = piece.ball.center.to_array();
    bytes.extend([x, y, z, piece.ball.radius].map(f32::to_le_bytes).as_flattened());
    bytes.extend(piece.color.to_bytes());
    let texture = piece.texture.and_then(|number| u16::try_from(number).ok()).unwrap_or(NONE);
    bytes.extend([texture, 0].map(u16::to_le_bytes).as_flattened());
    bytes.extend(piece.grids.origin.map(i32::to_le_bytes).as_flattened());
    bytes.extend(piece.grids.shifts.map(u16::to_le_bytes).as_flattened());
    bytes
}

fn entry(texture: &Texture, place: usize) -> Vec<u8> {
    let colors = u16::try_from(texture.palette.len()).unwrap_or(0);
    let [width, height] = texture.size;
    let mut bytes =
        [texture.format.code() as u16, colors, width, height].map(u16::to_le_bytes).as_flattened().to_vec();
    bytes.extend([place, length(texture)].map(|n| count(n).to_le_bytes()).as_flattened());
    bytes
}

/// The bytes of a palette and of all levels.
pub(super) fn length(texture: &Texture) -> usize {
    4 * texture.palette.len() + texture.levels.iter().map(Vec::len).sum::<usize>()
}

/// A number below 2^32, as all of a model's are.
fn count(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}
