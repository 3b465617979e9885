#!/usr/bin/env bash
# One shard of `saccade eval` or `saccade run` as a task of a batch system.
#
#   Slurm:         sbatch cluster.sh eval DATASET OUT [OPTION...]
#   GNU parallel:  parallel -q -j 4 env SLURM_ARRAY_TASK_ID={} bash cluster.sh eval DATASET OUT [OPTION...] ::: {1..16}
#
# OPTIONs are those of the command, which may also be `run`. The results of shard i are in OUT/i. Then, once, for `eval`:
#
#   saccade eval --status OUT/*/          what is missing
#   saccade eval --merge OUT/*/ --out OUT.merged
#
# The number of shards must stay the same until the last one is done: SHARDS, and in --array.
#SBATCH --array=1-16
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --signal=B:TERM@120
#SBATCH --requeue
set -u
shards=${SHARDS:-16}
shard=${SLURM_ARRAY_TASK_ID:?this script is for sbatch, see its head}
command=$1 source=$2 out=$3
shift 3
[[ $command == run ]] && set -- --resume "$@"

# Slurm warns 120 s before the time is over: the command then ends with status 4, with every frame so far on disk.
saccade "$command" "$source" --out "$out/$shard" --shard "$shard/$shards" --workers "${SLURM_CPUS_PER_TASK:-1}" "$@" &
process=$!
trap 'kill -TERM "$process"' TERM INT
wait "$process"
status=$?
while kill -0 "$process" 2>/dev/null; do  # a signal ended `wait`
  wait "$process"
  status=$?
done
if [[ $status == 4 && -n ${SLURM_JOB_ID:-} ]]; then scontrol requeue "${SLURM_ARRAY_JOB_ID:-$SLURM_JOB_ID}_$shard"; fi
exit "$status"
