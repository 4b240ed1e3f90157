// Marks the items that are kept, and counts them in groups. What is kept of an item, 0 for nothing, the file before this one says: `kept(item)`.

@group(1) @binding(0) var<storage, read_write> picked: array<u32>;  // per item: 0, or what is kept of it
@group(1) @binding(1) var<storage, read_write> counts: array<u32>;  // per group: how many
@group(1) @binding(2) var<storage, read> items: array<u32>;         // three corners each
@group(1) @binding(3) var<uniform> selection: Selection;

var<workgroup> count: atomic<u32>;

@compute @workgroup_size(256)
fn pick(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) group: vec3u) {
    if id.x < selection.items {
        let what = kept(id.x);
        picked[id.x] = what;
        if what != 0u {
            atomicAdd(&count, 1u);
        }
    }
    workgroupBarrier();
    if lane == 0u {
        counts[group.x] = atomicLoad(&count);
    }
}
