//! A baked file as a model again: for pictures of it, and for its errors.

use super::Asset;
use crate::error::Error;
use crate::scene::{Image, Model, Vertex};
use alberti::Geometry as _;
use alberti::baked::{Attribute, Baked, BakedError, BakedPart, Color, Normal, Tangent, Texels, Uv};
use alberti::texture::Mipmap;
use alberti::texture::format::Storage;

/// The model with meshes, colours and surfaces' textures of a file, and all else of its own: lights, and the images
/// that are not the colours of a surface.
///
/// # Errors
/// The library does not read the file.
pub fn restored(file: &[u8], asset: &Asset, original: &Model) -> Result<Model, Error> {
    let baked = Baked::read(file).map_err(unread)?;
    let mut model = Model { vertices: vec![], ..original.clone() };
    model.parts.iter_mut().for_each(|part| part.triangles.clear());
    for (part, piece) in baked.parts().zip(&asset.pieces) {
        let first = u32::try_from(model.vertices.len()).unwrap_or(u32::MAX);
        let mesh = part.mesh::<()>().map_err(unread)?;
        let mut vertices: Vec<_> = (0..mesh.vertices())
            .filter_map(|number| mesh.vertex(number))
            .map(|(place, ())| Vertex { position: place.coords.to_array(), ..Vertex::default() })
            .collect();
        put::<Uv>(&part, &mut vertices, |vertex, uv| vertex.uv = uv.to_array());
        put::<Normal>(&part, &mut vertices, |vertex, normal| vertex.normal = normal.to_array());
        put::<Tangent>(&part, &mut vertices, |vertex, tangent| vertex.tangent = tangent.to_array());
        put::<Color>(&part, &mut vertices, |vertex, color| vertex.color = color.to_array());
        model.vertices.extend(vertices);
        let index = |index: usize| first + u32::try_from(index).unwrap_or(u32::MAX);
        let triangles = (0..mesh.triangles()).filter_map(|number| mesh.triangle(number));
        let place = &mut model.parts[piece.part];
        place.triangles = triangles.map(|triangle| triangle.map(index)).collect();
        place.diffuse = {
            let [r, g, b, _] = part.color().to_bytes();
            [r, g, b].map(|c| f32::from(c) / 255.0)
        };
        if let Some(number) = part.texture()
            && let Some(texels) = baked.texture(number)
        {
            place.texture = Some(model.textures.len());
            model.textures.push(largest(&texels).into());
        }
    }
    Ok(model)
}

fn unread(error: BakedError) -> Error {
    Error::new(format!("a file that is not read ({error})"), "one that is")
}

/// Puts attributes of a part, if the file has them, into its vertices.
fn put<A: Attribute>(part: &BakedPart<'_>, vertices: &mut [Vertex], put: impl Fn(&mut Vertex, A::Varying)) {
    let Ok(mesh) = part.mesh::<A>() else { return };
    for (number, vertex) in vertices.iter_mut().enumerate() {
        if let Some((_, varying)) = mesh.vertex(number) {
            put(vertex, varying);
        }
    }
}

/// The colours of level 0.
fn largest(texels: &Texels<'_>) -> Image {
    match texels {
        Texels::Rgb565(map) => image(map),
        Texels::Rgba4444(map) => image(map),
        Texels::L8(map) => image(map),
        Texels::Indexed4(map) => image(map),
        Texels::Indexed8(map) => image(map),
        Texels::Rgba8888(map) => image(map),
        Texels::Rgb8(map) => image(map),
        Texels::L16(map) => image(map),
        Texels::Rgb565Be(map) => image(map),
        Texels::Rgb332(map) => image(map),
        Texels::Indexed1(map) => image(map),
        Texels::Indexed2(map) => image(map),
        Texels::Rgb565Pairs(map) => image(map),
        Texels::Rgb565Alpha(map) => image(map),
        _ => Image { width: 1, height: 1, texels: vec![[0; 4]] },
    }
}

fn image<F: Storage>(map: &Mipmap<'_, F>) -> Image {
    let level = map.level(0);
    let (width, height) = (level.width(), level.height());
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    Image { width, height, texels: rows.map(|[x, y]| level.texel(x, y).to_bytes()).collect() }
}
