#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The script of `hyperex sweep --slurm`, run by a Slurm of one node that this test starts and ends.
#   slurm_test.sh PROGRAM
set -euo pipefail
PATH=$PATH:/usr/sbin
hyperex=$(realpath "$1")
for tool in munged slurmctld slurmd sbatch squeue; do
  command -v $tool > /dev/null || { echo "$tool is not installed"; exit 77; }
done
work=$(mktemp -d)
end() {
  for process in slurmd slurmctld munged; do
    [[ ! -s "$work/$process.pid" ]] || kill "$(< "$work/$process.pid")" 2> /dev/null || true
  done
  sleep 1
  rm -rf "$work"
}
trap end EXIT
source "$(dirname "$0")/study.sh"

# Ports that hardly anybody has: two tests at once do not meet.
port=$((20000 + $$ % 20000 * 2))
host=$(hostname -s)
mkdir "$work/state" "$work/spool"
head -c 1024 /dev/urandom > "$work/munge.key"
chmod 400 "$work/munge.key"
chmod 755 "$work"
cat > "$work/slurm.conf" << END
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$work/munge.sock
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$work/slurm.conf
munged --force --key-file="$work/munge.key" --socket="$work/munge.sock" --pid-file="$work/munged.pid" \
  --log-file="$work/munge.log" --seed-file="$work/munge.seed" 2> "$work/munge.err" &&
  slurmctld -f "$SLURM_CONF" && slurmd -f "$SLURM_CONF" ||
  { cat "$work"/*.err "$work"/*.log; echo "no Slurm can be started here"; exit 77; }
for ((i = 0; i < 100; ++i)); do
  [[ "$(sinfo -h -o %T 2> /dev/null || true)" != idle ]] || break
  sleep 0.2
done
[[ "$(sinfo -h -o %T)" == idle ]] || { cat "$work"/*.log; echo "no Slurm can be started here"; exit 77; }

wait_for_jobs() {
  for ((i = 0; i < 1000; ++i)); do
    [[ -n "$(squeue -h)" ]] || return 0
    sleep 0.2
  done
  squeue
  said "the jobs do not end"
}
write_study "$broken"
"$hyperex" sweep "my study/study.toml" --slurm > script.sh
bash script.sh
wait_for_jobs
expect_two_of_three
before=$(written)
write_study "$sound"
bash script.sh
wait_for_jobs
[[ "$(states)" == "$all_three" ]] || said "the table: $(states)"
[[ "$before" == "$(written)" ]] || said "a finished case was run again"
