//! Textures between the crate that makes them and the one that holds what is drawn.

use pelage_coat::{Encoding, FinTexture, MipImage, ShellLayer, ShellTexture};
use pelage_graph::NodeError;
use pelage_volume::{BlockImage, CompressedStack, Image, Shell, ShellStack, Work};

pub(super) fn shell_texture(stack: ShellStack) -> ShellTexture {
    ShellTexture {
        encoding: Encoding::Rgba8,
        images: stack.images(),
        mixtures: 1,
        mips: stack.mips.into_iter().map(mip).collect(),
        levels: layers(&stack.levels),
        directions: stack.directions.map(|map| map.into_iter().map(mip).collect()),
    }
}

pub(super) fn compressed_texture(stack: CompressedStack) -> ShellTexture {
    let block_mip = |mip: BlockImage| MipImage { width: mip.width, height: mip.height, texels: mip.blocks };
    ShellTexture {
        encoding: Encoding::Bc3,
        images: stack.mips.first().map_or(0, |mip| mip.layers),
        mixtures: 1,
        mips: stack.mips.into_iter().map(block_mip).collect(),
        levels: layers(&stack.levels),
        directions: stack.directions.map(|map| map.into_iter().map(mip).collect()),
    }
}

pub(super) fn fin_texture(fin: pelage_volume::FinTexture) -> FinTexture {
    FinTexture { tiles_across: fin.tiles_across as f32, mixtures: 1, mips: fin.mips.into_iter().map(mip).collect() }
}

/// The way back, of one mixture; blocks are decoded. What a coat does not keep is as if the stack were one tile side high and had cost nothing.
pub(super) fn shell_stack(texture: &ShellTexture) -> Result<ShellStack, NodeError> {
    texture.check()?;
    let levels = texture.levels.iter().map(|shells| shells.iter().map(shell).collect()).collect();
    let image = |mip: &MipImage| Image { width: mip.width, height: mip.height, layers: texture.images, texels: mip.texels.clone() };
    let directions = texture.directions.as_ref().map(|map| map.iter().map(image).collect());
    Ok(match texture.encoding {
        Encoding::Rgba8 => {
            ShellStack { height: 1.0, mips: texture.mips.iter().map(image).collect(), levels, directions, work: Work::default() }
        }
        Encoding::Bc3 => {
            let blocks =
                |mip: &MipImage| BlockImage { width: mip.width, height: mip.height, layers: texture.images, blocks: mip.texels.clone() };
            CompressedStack { height: 1.0, mips: texture.mips.iter().map(blocks).collect(), levels, directions }.decoded()
        }
    })
}

fn layers(levels: &[Vec<Shell>]) -> Vec<Vec<ShellLayer>> {
    let layer =
        |&Shell { height, light_height, image, opacity, layers }: &Shell| ShellLayer { height, light_height, image, opacity, layers };
    levels.iter().map(|shells| shells.iter().map(layer).collect()).collect()
}

fn shell(&ShellLayer { height, light_height, image, opacity, layers }: &ShellLayer) -> Shell {
    Shell { height, light_height, image, opacity, layers }
}

fn mip(image: Image) -> MipImage {
    MipImage { width: image.width, height: image.height, texels: image.texels }
}
