// Packs picked items in their order: each group of 256 counts its own (pick.wgsl), one group sums the
// counts up, and each group puts its items behind those of the groups before it. Blelloch 1990, *Prefix sums and their applications*.

const GROUP: u32 = 256u;

@group(0) @binding(0) var<storage, read> picked: array<u32>;        // per item: 0, or what is kept of it
@group(0) @binding(1) var<storage, read_write> counts: array<u32>;  // per group: how many; then how many before it
@group(0) @binding(2) var<storage, read> items: array<u32>;         // three corners each
@group(0) @binding(3) var<storage, read> runs: array<u32>;          // per item: which run it is of; each is drawn from the first item to the end of a run
@group(0) @binding(4) var<storage, read_write> survivors: array<u32>;
@group(0) @binding(5) var<storage, read_write> draws: array<u32>;   // the arguments of a draw for each run, five words
@group(0) @binding(6) var<uniform> selection: Selection;

var<workgroup> sums: array<u32, 256>;

// How many of the group's flags before `lane` are set.
fn before(lane: u32, flag: u32) -> u32 {
    sums[lane] = flag;
    workgroupBarrier();
    for (var reach = 1u; reach < GROUP; reach *= 2u) {
        var sum = sums[lane];
        if lane >= reach {
            sum += sums[lane - reach];
        }
        workgroupBarrier();
        sums[lane] = sum;
        workgroupBarrier();
    }
    return sums[lane] - flag;
}

@compute @workgroup_size(256)
fn sum_groups(@builtin(local_invocation_index) lane: u32) {
    var total = 0u;
    for (var first = 0u; first < selection.groups; first += GROUP) {
        let group = first + lane;
        var count = 0u;
        if group < selection.groups {
            count = counts[group];
        }
        let place = before(lane, count);
        let all = workgroupUniformLoad(&sums[GROUP - 1u]);
        if group < selection.groups {
            counts[group] = total + place;
        }
        total += all;
    }
}

@compute @workgroup_size(256)
fn pack(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) group: vec3u) {
    let item = id.x;
    var kept = 0u;
    if item < selection.items {
        kept = picked[item];
    }
    let flag = select(0u, 1u, kept != 0u);
    let place = before(lane, flag);
    if item >= selection.items {
        return;
    }
    let rank = counts[group.x] + place;
#if FACES
    if kept != 0u {
        for (var corner = 0u; corner < 3u; corner++) {
            survivors[3u * rank + corner] = items[3u * item + corner];
        }
    }
#else
    if kept != 0u {
        survivors[2u * rank] = item;
        survivors[2u * rank + 1u] = kept;
    }
#endif
    // The last of a run says how many there are up to it.
#if FACES
    let run = runs[item];
    if item + 1u == selection.items || runs[item + 1u] != run {
        draws[5u * run] = 3u * (rank + flag);
    }
#else
    if item + 1u == selection.items {
        draws[1] = rank + flag;
    }
#endif
}
