//! A Gaussian over the torus.

use crate::gauss::integral;
use crate::plane::Plane;

/// Blurs a plane with a Gaussian of deviation `sigma` texels, all periodic images summed, mass kept.
pub(crate) fn blur(plane: &mut Plane, sigma: f64) {
    if sigma < 1e-3 {
        return;
    }
    let across = kernel(sigma, plane.width);
    let down = kernel(sigma, plane.height);
    let (width, height) = (plane.width, plane.height);
    let mut lane = Vec::new();
    for row in 0..height {
        convolve(&mut plane.texels, row * width, 1, width, &across, &mut lane);
    }
    for column in 0..width {
        convolve(&mut plane.texels, column, width, height, &down, &mut lane);
    }
}

/// Weights for 0, 1, …, period − 1 texels away on the circle: the Gaussian integrated over each texel, images summed, normalised.
fn kernel(sigma: f64, period: usize) -> Vec<f32> {
    let images = (6.0 * sigma / period as f64).ceil() as i64 + 1;
    let weight = |x: f64| integral((x + 0.5) / sigma) - integral((x - 0.5) / sigma);
    let summed: Vec<f64> = (0..period).map(|i| (-images..=images).map(|k| weight(i as f64 + (k * period as i64) as f64)).sum()).collect();
    let total: f64 = summed.iter().sum();
    summed.iter().map(|w| (w / total) as f32).collect()
}

/// Replaces a lane of `count` texels `stride` apart by its circular convolution.
fn convolve(texels: &mut [[f32; 4]], start: usize, stride: usize, count: usize, kernel: &[f32], lane: &mut Vec<[f32; 4]>) {
    lane.clear();
    lane.extend((0..count).map(|i| texels[start + i * stride]));
    for i in 0..count {
        let mut sum = [0.0f32; 4];
        for (j, source) in lane.iter().enumerate() {
            let weight = kernel[if i >= j { i - j } else { i + count - j }];
            for channel in 0..4 {
                sum[channel] += weight * source[channel];
            }
        }
        texels[start + i * stride] = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_knows_the_torus() {
        for sigma in [0.1, 1.0, 16.0, 64.0] {
            let weights = kernel(sigma, 64);
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            // Left and right are the same, the border none.
            assert!((1..64).all(|i| (weights[i] - weights[64 - i]).abs() < 1e-7), "σ {sigma}");
        }
        // As wide as the tile, it forgets where the hair stood.
        assert!(kernel(64.0, 64).iter().all(|w| (w * 64.0 - 1.0).abs() < 1e-4));
    }
}
