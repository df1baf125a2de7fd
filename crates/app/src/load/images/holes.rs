//! Colours in holes. Filters mix a texture's colours without its alpha, so those of texels that are clear show at the
//! rims of what is not: programs write them black.

use crate::scene::Image;

/// Colours, and in place of an alpha their weight.
struct Level {
    width: usize,
    texels: Vec<[u8; 4]>,
}

impl Level {
    /// The colours of squares of four, by weight.
    fn halved(&self) -> Self {
        let height = self.texels.len() / self.width;
        let [width, rows] = [self.width, height].map(|side| side.div_ceil(2));
        let square = |index: usize| {
            let (x, y) = (index % width * 2, index / width * 2);
            let all = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
            let texels = all.into_iter().filter(|&(x, y)| x < self.width && y < height);
            let mut sums = [0_u32; 4];
            for (x, y) in texels {
                let [r, g, b, weight] = self.texels[y * self.width + x].map(u32::from);
                let weighted = [r * weight, g * weight, b * weight, weight];
                sums = [0, 1, 2, 3].map(|k| sums[k] + weighted[k]);
            }
            let [.., weight] = sums;
            let mean = |sum: u32| ((sum + weight / 2) / weight.max(1)).to_le_bytes()[0];
            [mean(sums[0]), mean(sums[1]), mean(sums[2]), u8::try_from(weight).unwrap_or(u8::MAX)]
        };
        Self { width, texels: (0..width * rows).map(square).collect() }
    }

    /// Gives texels without weight the colours of the squares that they are in.
    fn fill(&mut self, halved: &Self) {
        for (index, texel) in self.texels.iter_mut().enumerate().filter(|(_, [.., weight])| *weight == 0) {
            let (x, y) = (index % self.width / 2, index / self.width / 2);
            let [r, g, b, _] = halved.texels[y * halved.width + x];
            *texel = [r, g, b, 0];
        }
    }
}

/// The image with the colours of what is near where it is clear; `None` without such places, or without any other.
/// Nothing else of it changes.
pub(super) fn filled(image: &Image) -> Option<Image> {
    let is_clear = |[.., alpha]: &[u8; 4]| *alpha == 0;
    if !image.texels.iter().any(is_clear) || image.texels.iter().all(is_clear) {
        return None;
    }
    let mut levels = vec![Level { width: image.width as usize, texels: image.texels.clone() }];
    while let Some(last) = levels.last().filter(|last| last.texels.iter().any(is_clear)) {
        levels.push(last.halved());
    }
    while let (Some(halved), Some(level)) = (levels.pop(), levels.last_mut()) {
        level.fill(&halved);
        if levels.len() == 1 {
            break;
        }
    }
    Some(Image { texels: levels.pop()?.texels, ..*image })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_have_the_colours_of_what_is_near() {
        let [clear, red, blue] = [[0; 4], [200, 0, 0, 255], [0, 0, 100, 1]];
        let mut texels = vec![clear; 7 * 5];
        (texels[0], texels[34]) = (red, blue);
        let image = Image { width: 7, height: 5, texels };
        let filled = filled(&image).expect("holes");
        for (index, (new, old)) in filled.texels.iter().zip(&image.texels).enumerate() {
            assert_eq!(new[3], old[3]);
            assert!(old[3] == 0 || new == old, "{index}");
        }
        assert_eq!([1, 7, 8].map(|k: usize| filled.texels[k]), [[200, 0, 0, 0]; 3]);
        assert_eq!(filled.texels[33], [0, 0, 100, 0]);
        // From afar, by their weights.
        assert_eq!(filled.texels[6], [199, 0, 0, 0]);
        assert!(super::filled(&filled).is_some_and(|again| again == filled));
        for texels in [vec![clear; 4], vec![red; 4], vec![blue; 4]] {
            assert!(super::filled(&Image { width: 2, height: 2, texels }).is_none());
        }
    }
}
