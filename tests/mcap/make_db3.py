"""Writes a database of rosbag2 (storage sqlite3, schema version 4) of the topics and messages in a JSON text on standard
input: {"encoding": "cdr", "topics": [{"name", "type"}], "rows": [[topic, time in ns, data in hex]]}."""

import json
import os
import sqlite3
import sys

TABLES = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
  serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
  encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES (4, 'jazzy');
"""


def main():
    content = json.load(sys.stdin)
    if os.path.exists(sys.argv[1]):
        os.remove(sys.argv[1])
    with sqlite3.connect(sys.argv[1]) as bag:
        bag.executescript(TABLES)
        for number, topic in enumerate(content["topics"], 1):
            bag.execute("INSERT INTO topics VALUES (?, ?, ?, ?, '', '')",
                        (number, topic["name"], topic["type"], content["encoding"]))
        bag.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
                        ((topic, int(time), bytes.fromhex(data)) for topic, time, data in content["rows"]))


main()
