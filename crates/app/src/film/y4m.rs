//! YUV4MPEG2, which programs for films read: planes of full size, colours by ITU-R BT.709 from 16 to 235 or 240.

use super::rate::Rate;
use crate::scene::Image;

/// The stream's first line.
pub(super) fn header([width, height]: [u32; 2], Rate { frames, seconds }: Rate) -> Vec<u8> {
    format!("YUV4MPEG2 W{width} H{height} F{frames}:{seconds} Ip A1:1 C444 XCOLORRANGE=LIMITED\n")
        .into_bytes()
}

/// Appends a frame.
pub(super) fn push(stream: &mut Vec<u8>, frame: &Image) {
    stream.extend_from_slice(b"FRAME\n");
    for plane in 0..3 {
        stream.extend(frame.texels.iter().map(|&texel| converted(texel)[plane]));
    }
}

/// Luma, and the differences of blue and of red from it.
fn converted([r, g, b, _]: [u8; 4]) -> [u8; 3] {
    let [r, g, b] = [r, g, b].map(f64::from);
    let luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let [blue, red] = [(b - luma) / 1.8556, (r - luma) / 1.5748];
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 16 to 240")]
    [16.0 + luma * 219.0 / 255.0, 128.0 + blue * 224.0 / 255.0, 128.0 + red * 224.0 / 255.0]
        .map(|x| x.round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the standard's primaries and greys in 8 bits.
    #[test]
    fn colours_are_those_of_the_standard() {
        for (rgb, yuv) in [
            ([0, 0, 0], [16, 128, 128]),
            ([255, 255, 255], [235, 128, 128]),
            ([255, 0, 0], [63, 102, 240]),
            ([0, 255, 0], [173, 42, 26]),
            ([0, 0, 255], [32, 240, 118]),
        ] {
            let [r, g, b] = rgb;
            assert_eq!(converted([r, g, b, 255]), yuv, "{rgb:?}");
        }
        let mut stream = header([2, 1], Rate { frames: 24, seconds: 1 });
        push(&mut stream, &Image { width: 2, height: 1, texels: vec![[255; 4], [0, 0, 0, 255]] });
        let (head, frame) = stream.split_at(stream.iter().position(|&b| b == b'\n').unwrap() + 1);
        assert!(head.starts_with(b"YUV4MPEG2 W2 H1 F24:1 "));
        assert_eq!(frame, [b"FRAME\n", &[235, 16, 128, 128, 128, 128][..]].concat());
    }
}
