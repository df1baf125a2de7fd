//! `mint` and `bytemuck`, judged by glam's matrices and by bytes.

use alberti::glam::{Mat2, Mat3, Mat4, Vec2, Vec3};
use alberti::math::{Frame2, NotAffine, Point2, Vector2};
use alberti::*;

/// Small integers, so that sums in any order are exact.
fn frame() -> Frame<Object, World> {
    let vector = |x, y, z| Vector3::new(Vec3::new(x, y, z));
    let origin = Point3::new(Vec3::new(3.0, -2.0, 5.0));
    Frame::new(origin, vector(1.0, 0.0, 7.0), vector(2.0, 1.0, 0.0), vector(-4.0, 3.0, 1.0))
}

#[test]
fn points_and_vectors_keep_what_they_are() {
    let point = Point3::<World>::new(Vec3::new(1.0, 2.0, 3.0));
    let minted: mint::Point3<f32> = point.into();
    assert_eq!([minted.x, minted.y, minted.z], [1.0, 2.0, 3.0]);
    assert_eq!(Point3::<World>::from(minted), point);

    let vector = Vector2::<Eye>::from(mint::Vector2 { x: 4.0, y: 5.0 });
    assert_eq!(vector, Vector2::new(Vec2::new(4.0, 5.0)));
    fn minted_by<T: mint::IntoMint>(value: T) -> T::MintType {
        value.into()
    }
    assert_eq!(minted_by(vector), mint::Vector2 { x: 4.0, y: 5.0 });
}

#[test]
fn frames_are_matrices_of_glam() {
    let frame = frame();
    let matrix = Mat4::from(mint::ColumnMatrix4::from(frame));
    for place in [Vec3::ZERO, Vec3::X, Vec3::new(-3.0, 8.0, 11.0)] {
        assert_eq!(matrix.project_point3(place), frame.to_parent(Point3::new(place)).coords);
    }
    assert_eq!(Frame::try_from(mint::ColumnMatrix4::from(matrix)), Ok(frame));
    assert_eq!(Frame::from(mint::ColumnMatrix3x4::from(frame)), frame);
    let affine = mint::ColumnMatrix3x4::from(frame);
    assert_eq!([affine.y.x, affine.z.y, affine.w.z], [2.0, 3.0, 5.0]);

    let plane = Frame2::<Object, World>::from_mat2(
        Mat2::from_cols(Vec2::new(2.0, 1.0), Vec2::new(-1.0, 4.0)),
        Point2::new(Vec2::new(7.0, -6.0)),
    );
    let matrix = Mat3::from(mint::ColumnMatrix3::from(plane));
    let place = Vec2::new(3.0, 5.0);
    assert_eq!(matrix.transform_point2(place), plane.to_parent(Point2::new(place)).coords);
    assert_eq!(Frame2::try_from(mint::ColumnMatrix3::from(matrix)), Ok(plane));
    assert_eq!(Frame2::from(mint::ColumnMatrix2x3::from(plane)), plane);
}

#[test]
fn matrices_with_perspective_are_no_frames() {
    let of = |matrix: Mat4| Frame::<Object, World>::try_from(mint::ColumnMatrix4::from(matrix));
    let lens = alberti::glam::camera::rh::proj::directx::perspective(0.7, 1.5, 0.1, 100.0);
    assert_eq!(of(lens), Err(NotAffine));
    for (column, row) in [(0, 3), (1, 3), (2, 3), (3, 3)] {
        let mut columns = Mat4::IDENTITY.to_cols_array_2d();
        columns[column][row] += 0.5;
        assert_eq!(of(Mat4::from_cols_array_2d(&columns)), Err(NotAffine), "{column} {row}");
    }
    assert_eq!(NotAffine.to_string(), "the last row of a frame's matrix must be 0, ..., 0, 1");
}

#[test]
fn vertices_are_bytes_and_numbers() {
    use bytemuck::TransparentWrapper;
    let points =
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]].map(|place| Point3::<Object>::new(Vec3::from_array(place)));
    let coordinates: &[Vec3] = Point3::peel_slice(&points);
    let numbers: &[f32] = bytemuck::cast_slice(coordinates);
    assert_eq!(numbers, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    // The coordinates of a file are points of a space without a copy.
    let named: &[Point3<Object>] = Point3::wrap_slice(bytemuck::cast_slice(numbers));
    assert_eq!(named, points);
    assert_eq!(named.as_ptr().addr(), points.as_ptr().addr());
    assert_eq!(Vector3::<World>::wrap_ref(&Vec3::X), &Vector3::new(Vec3::X));
    assert_eq!(<Point3<World> as bytemuck::Zeroable>::zeroed(), Point3::new(Vec3::ZERO));
}

#[test]
fn plain_values_are_their_bits() {
    let bytes = [1.0_f32, 2.0].map(f32::to_ne_bytes);
    assert_eq!(bytemuck::cast_slice::<_, u8>(&[Flat(1.0_f32), Flat(2.0)]), bytes.as_flattened());
    assert_eq!(bytemuck::cast_slice::<_, u8>(&[Linear(1.0_f32), Linear(2.0)]), bytes.as_flattened());
    assert_eq!(bytemuck::cast::<Rgba8, u32>(Rgba8::new(1, 2, 3, 4)), 0x04_03_02_01);
    assert_eq!(bytemuck::cast::<Rgba565, u32>(Rgba565::from_bits(7)), 7);
    assert_eq!(bytemuck::cast::<Q16, i32>(Q16::ONE), 1 << 16);
    assert_eq!(bytemuck::cast::<Fixed, u32>(Fixed::from_bits(77)), 77);
}
